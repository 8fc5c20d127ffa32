// The bare loops that the tools are measured against, and the watch that measures.
//
//   speed filter [COLUMNS] <FILE    parse two numbers of each row, pass its bytes through, append
//   COLUMNS (1) new numbers speed fit <FILE                 parse two numbers of each row, add up
//   what a straight line through their logarithms takes speed print ROWS                rows of two
//   numbers speed compare ROUNDS cpu|elapsed COMMAND OTHER
//                                   two shell commands in turn: median seconds of each; median,
//                                   least and greatest ratio OTHER/COMMAND
//   speed peak COMMAND              the largest resident memory of any of its processes [KiB]
//
// The loops are what no tool of this kind can do without, and nothing else: no other form of file,
// no header, no message. The new numbers have as many digits as doubles have, as those that the
// tools compute.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace {

class Writer {
 public:
  ~Writer() { flush(); }
  void bytes(const char* from, std::size_t count) {
    to_ = static_cast<char*>(std::memcpy(to_, from, count)) + count;
  }
  void byte(char c) { *to_++ = c; }
  void number(double x) { to_ = fmt::format_to(to_, FMT_COMPILE("{}"), x); }
  void end_line() {
    *to_++ = '\n';
    if (to_ - out_.data() >= 1 << 16) flush();
  }

 private:
  void flush() {
    for (const char* from = out_.data(); from != to_;) {
      const ssize_t count = ::write(STDOUT_FILENO, from, static_cast<std::size_t>(to_ - from));
      if (count < 0) std::_Exit(2);
      from += count;
    }
    to_ = out_.data();
  }
  std::vector<char> out_ = std::vector<char>(1 << 18);
  char* to_ = out_.data();
};

/// Calls row(line, its end, first number, second number) for each; comments are passed over.
template <typename Row>
void rows(Row row) {
  std::vector<char> in(1 << 18);
  std::size_t kept = 0;
  for (ssize_t count; (count = ::read(STDIN_FILENO, in.data() + kept, in.size() - kept)) > 0;) {
    const char *line = in.data(), *const end = line + kept + count;
    for (const char* feed; (feed = static_cast<const char*>(
                                std::memchr(line, '\n', static_cast<std::size_t>(end - line))));
         line = feed + 1) {
      if (*line == '#') continue;
      double x, y;
      const char* const gap = std::from_chars(line, feed, x).ptr;
      if (gap == line || gap == feed || std::from_chars(gap + 1, feed, y).ec != std::errc())
        std::_Exit(2);
      row(line, feed, x, y);
    }
    kept = static_cast<std::size_t>(end - line);
    std::memmove(in.data(), line, kept);
  }
}

void filter(int columns) {
  Writer out;
  rows([&](const char* line, const char* end, double x, double y) {
    out.bytes(line, static_cast<std::size_t>(end - line));
    for (int i = 0; i < columns; ++i) {
      out.byte('\t');
      out.number((x + y) / (3 + i));
    }
    out.end_line();
  });
}

void fit() {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  rows([&](const char*, const char*, double x, double y) {
    const double u = std::log(x), w = std::log(y);
    ++n, sx += u, sy += w, sxx += u * u, sxy += u * w;
  });
  const double b = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  fmt::print("{}\t{}\n", std::exp((sy - b * sx) / n), b);
}

void print(double n) {
  Writer out;
  for (double i = 0; i < n; ++i) {
    out.number(i / 1000);
    out.byte('\t');
    out.number(0.5 - i / (3 * n));
    out.end_line();
  }
}

struct Used {
  double elapsed, cpu;
  long peak;
};

Used run(const char* command) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::execl("/bin/sh", "sh", "-c", command, nullptr);
    std::_Exit(127);
  }
  int status;
  rusage used{};
  if (::wait4(child, &status, 0, &used) != child || status != 0) {
    fmt::print(stderr, "speed: this failed: {}\n", command);
    std::_Exit(2);
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          seconds(used.ru_utime) + seconds(used.ru_stime), used.ru_maxrss};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

void compare(int rounds, double Used::*what, const char* command, const char* other) {
  std::vector<double> one, two, ratio;
  for (int i = 0; i < rounds; ++i) {
    one.push_back(run(command).*what);
    two.push_back(run(other).*what);
    ratio.push_back(two.back() / one.back());
  }
  fmt::print("{:.4f} {:.4f} {:.3f} {:.3f} {:.3f}\n", median(one), median(two), median(ratio),
             *std::min_element(ratio.begin(), ratio.end()),
             *std::max_element(ratio.begin(), ratio.end()));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "filter") filter(argc > 2 ? std::atoi(argv[2]) : 1);
  else if (what == "fit") fit();
  else if (what == "print" && argc == 3) print(std::strtod(argv[2], nullptr));
  else if (what == "compare" && argc == 6)
    compare(std::atoi(argv[2]), std::string_view(argv[3]) == "cpu" ? &Used::cpu : &Used::elapsed,
            argv[4], argv[5]);
  else if (what == "peak" && argc == 3) fmt::print("{}\n", run(argv[2]).peak);
  else return 2;
}
