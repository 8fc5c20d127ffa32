// SPDX-License-Identifier: GPL-3.0-or-later
// The bare loops that the tools are measured against, and the watch that measures.
//
//   speed filter [COLUMNS] <FILE    parse two numbers of each row, pass its bytes through, append
//                                   COLUMNS (1) new numbers
//   speed fit <FILE                 parse two numbers of each row, add up what a straight line
//                                   through their logarithms and its standard errors take: no
//                                   residuals, so no row is kept
//   speed print ROWS                rows of two numbers
//   speed compare ROUNDS user|cpu|elapsed COMMAND OTHER
//                                   two shell commands in turn: median seconds of each; median,
//                                   least and greatest ratio OTHER/COMMAND; rounds that other
//                                   processes disturbed
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
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "text/from_chars.h"

namespace {

/// Text on its way out, in writes of 64 KiB.
struct Out {
  std::vector<char> block = std::vector<char>(1 << 17);
  char* to = block.data();

  void end_line() {
    *to++ = '\n';
    if (to - block.data() >= 1 << 16) flush();
  }
  void flush() {
    for (const char* from = block.data(); from != to;) {
      const ssize_t count = ::write(STDOUT_FILENO, from, static_cast<std::size_t>(to - from));
      if (count < 0) std::_Exit(2);
      from += count;
    }
    to = block.data();
  }
};

/// Calls row(line, its end, first number, second number) for each line; lines that begin with # are
/// passed over. The numbers may stand in quotes.
template <typename Row>
void rows(Row row) {
#ifdef F_SETPIPE_SZ
  ::fcntl(STDIN_FILENO, F_SETPIPE_SZ, 1 << 20);  // as the tools do
#endif
  std::vector<char> in(1 << 18);
  std::size_t kept = 0;
  for (ssize_t count; (count = ::read(STDIN_FILENO, in.data() + kept, in.size() - kept)) > 0;) {
    const char *line = in.data(), *const end = line + kept + count;
    const auto* const last =
        static_cast<const char*>(::memrchr(line, '\n', static_cast<std::size_t>(end - line)));
    while (last && line <= last) {
      const char* feed = line;
      if (*line != '#') {
        double x, y;
        const auto first = rolling::from_chars(line + (*line == '"'), last, x);
        const char* next = first.ptr + (*first.ptr == '"') + 1;
        next += *next == '"';
        const auto second = rolling::from_chars(next, last, y);
        if (first.ec != std::errc() || second.ec != std::errc()) std::_Exit(2);
        feed = static_cast<const char*>(
            std::memchr(second.ptr, '\n', static_cast<std::size_t>(end - second.ptr)));
        row(line, feed, x, y);
      } else {
        feed =
            static_cast<const char*>(std::memchr(line, '\n', static_cast<std::size_t>(end - line)));
      }
      line = feed + 1;
    }
    kept = static_cast<std::size_t>(end - line);
    std::memmove(in.data(), line, kept);
  }
}

void filter(int columns) {
  Out out;
  rows([&](const char* line, const char* end, double x, double y) {
    char* to = static_cast<char*>(std::memcpy(out.to, line, static_cast<std::size_t>(end - line))) +
               (end - line);
    for (int i = 0; i < columns; ++i) {
      *to++ = '\t';
      to = fmt::format_to(to, FMT_COMPILE("{}"), (x + y) / (3 + i));
    }
    out.to = to;
    out.end_line();
  });
  out.flush();
}

void fit() {
  double n = 0, x0 = 0, y0 = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  rows([&](const char*, const char*, double x, double y) {
    const double log_x = std::log(x), log_y = std::log(y);
    if (n == 0) x0 = log_x, y0 = log_y;  // sums about the first row lose fewer digits
    const double u = log_x - x0, w = log_y - y0;
    ++n, sx += u, sy += w, sxx += u * u, sxy += u * w, syy += w * w;
  });
  const double xx = sxx - sx * sx / n, xy = sxy - sx * sy / n, yy = syy - sy * sy / n, b = xy / xx,
               mean_x = x0 + sx / n, variance = (yy - b * xy) / (n - 2);
  const double a = std::exp(y0 + sy / n - b * mean_x);
  fmt::print("{}\t{}\t{}\t{}\n", a, a * std::sqrt(variance * (1 / n + mean_x * mean_x / xx)), b,
             std::sqrt(variance / xx));
}

void print(double n) {
  Out out;
  for (double i = 0; i < n; ++i) {
    out.to = fmt::format_to(out.to, FMT_COMPILE("{}\t{}"), i / 1000, 0.5 - i / (3 * n));
    out.end_line();
  }
  out.flush();
}

struct Used {
  double elapsed, user, cpu;
  long peak;
  double others = 0;  // of a core, that other processes have used meanwhile
};

/// The time that all processors have worked so far [s]; 0 where the system does not tell it.
double worked() {
  long long user = 0, nice = 0, system = 0;
  if (std::FILE* const file = std::fopen("/proc/stat", "r")) {
    if (std::fscanf(file, "cpu %lld %lld %lld", &user, &nice, &system) != 3)
      user = nice = system = 0;
    std::fclose(file);
  }
  return static_cast<double>(user + nice + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

Used run(const char* command) {
  const double before = worked();
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
  const double elapsed =
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
               user = seconds(used.ru_utime), cpu = user + seconds(used.ru_stime);
  return {elapsed, user, cpu, used.ru_maxrss, (worked() - before - cpu) / elapsed};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// A round in which other processes take more than a tenth of a core is repeated, but not for ever:
/// then as many as were disturbed are said.
void compare(int rounds, double Used::*what, const char* command, const char* other) {
  std::vector<double> one, two, ratio;
  int disturbed = 0;
  for (int left = rounds; static_cast<int>(one.size()) < rounds;) {
    const Used first = run(command), second = run(other);
    if (std::max(first.others, second.others) > 0.1) {
      if (left-- > 0) continue;
      ++disturbed;
    }
    one.push_back(first.*what);
    two.push_back(second.*what);
    ratio.push_back(two.back() / one.back());
  }
  fmt::print("{:.4f} {:.4f} {:.3f} {:.3f} {:.3f} {}\n", median(one), median(two), median(ratio),
             *std::min_element(ratio.begin(), ratio.end()),
             *std::max_element(ratio.begin(), ratio.end()), disturbed);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "filter") filter(argc > 2 ? std::atoi(argv[2]) : 1);
  else if (what == "fit") fit();
  else if (what == "print" && argc == 3) print(std::strtod(argv[2], nullptr));
  else if (what == "compare" && argc == 6)
    compare(std::atoi(argv[2]),
            std::string_view(argv[3]) == "user"  ? &Used::user
            : std::string_view(argv[3]) == "cpu" ? &Used::cpu
                                                 : &Used::elapsed,
            argv[4], argv[5]);
  else if (what == "peak" && argc == 3) fmt::print("{}\n", run(argv[2]).peak);
  else return 2;
}
