#include "cli/tool.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "cli/scene.h"
#include "text/estimate.h"
#include "text/head.h"
#include "text/input.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::string_view version = "1.0.0";
constexpr int trouble = 2;  // the exit status

void require(const Range& range, double value, std::string_view text) {
  if (!range.holds(value)) fail("'{}' must be {}", shown(text), range.text);
}

double to_number(const std::string& text, const Range& range) {
  double value;
  if (!parse_number(text, value)) fail("'{}' is not a number", shown(text));
  require(range, value, text);
  return value;
}

Estimate to_estimate(const std::string& text, const Range& range) {
  Estimate estimate;
  if (!parse_estimate(text, estimate)) fail("'{}' is not a number", shown(text));
  require(range, estimate.value, text);
  return estimate;
}

/// "a, b and c"
std::string enumeration(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

/// Writes one line of printable ASCII to standard error, at most 512 bytes. Allocates no memory, so
/// that it works when memory has run out.
void write_line(std::string_view name, std::string_view text) {
  std::array<char, 512> line;
  char* end = line.data();
  for (const std::string_view part : {name, std::string_view(": "), text})
    end += part.copy(end, static_cast<std::size_t>(line.data() + line.size() - 1 - end));
  std::replace_if(
      line.data(), end, [](char c) { return c < ' ' || c > '~'; }, '?');
  *end = '\n';
  // If this fails, there is no place left for a message.
  [[maybe_unused]] const auto count =
      ::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(end + 1 - line.data()));
}

/// The terminate handler. It reports exceptions that nothing catches: before main(), from a static
/// object, or while a message is being made.
[[noreturn]] void report_uncaught() {
  const char* what = "unknown error";
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    what = "out of memory";
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {}
  write_line(program_invocation_short_name, what);
  ::_exit(trouble);
}

/// Runs before the constructors of static objects.
[[gnu::constructor(101)]] void set_terminate_handler() { std::set_terminate(report_uncaught); }

std::string long_name(const std::string& names) {
  const auto at = names.find("--");
  return at == std::string::npos ? std::string() : names.substr(at + 2);
}

}  // namespace

Tool::Tool(std::string name, const std::string& purpose)
    : name_(std::move(name)), command_line_(name_, purpose) {
  flag("-q,--quiet", quiet_, "print no warnings, counts or progress on standard error");
}

Tool::~Tool() = default;

void Tool::add(const std::string& names, const std::string& type, const std::string& help, Set set,
               std::function<bool()> missing) {
  command_line_.option(names, type, help, [names, set](const std::string& text) {
    try {
      set(text);
    } catch (const Error& error) {
      fail("{}: {}", names, error.what());
    }
  });
  options_[long_name(names)] = {std::move(set), std::move(missing)};
}

void Tool::add_flag(const std::string& names, const std::string& help,
                    const std::function<void(bool)>& set) {
  command_line_.flag(names, help, [set] { set(true); });
  const auto set_from_text = [set](const std::string& text) {
    if (text != "true" && text != "false") fail("'{}' is neither true nor false", shown(text));
    set(text == "true");
  };
  options_[long_name(names)] = {set_from_text, {}};
}

void Tool::flag(const std::string& names, bool& value, const std::string& help) {
  add_flag(names, help, [&value](bool on) { value = on; });
}

void Tool::number(const std::string& names, double& value, const Range& range,
                  const std::string& help) {
  add(
      names, "NUMBER", help,
      [&value, range](const std::string& text) { value = to_number(text, range); },
      [&value] { return std::isnan(value); });
}

void Tool::count(const std::string& names, std::size_t& value, const Range& range,
                 const std::string& help) {
  add(names, "N", help, [&value, range](const std::string& text) {
    value = static_cast<std::size_t>(to_number(text, range));
  });
}

void Tool::estimate(const std::string& names, double& value, double* sigma, const Range& range,
                    const std::string& help) {
  add(
      names, "NUMBER", help,
      [&value, sigma, range](const std::string& text) {
    const Estimate estimate = to_estimate(text, range);
    value = estimate.value;
    if (sigma) *sigma = estimate.sigma;
      },
      [&value] { return std::isnan(value); });
}

void Tool::numbers(const std::string& names, std::vector<Estimate>& values, const Range& range,
                   const std::string& help) {
  add(
      names, "NUMBER,...", help,
      [&values, range](const std::string& text) {
    values.clear();
    for (const std::string& part : split_names(text, ','))
      values.push_back(to_estimate(part, range));
      },
      [&values] { return values.empty(); });
}

void Tool::text(const std::string& names, std::string& value, const std::string& type,
                const std::string& help) {
  add(names, type, help, [&value](const std::string& text) {
    if (text.empty()) fail("'' is no value");
    value = text;
  });
}

void Tool::list(const std::string& names, std::vector<std::string>& values, const std::string& type,
                const std::string& help) {
  command_line_.list(names, type, help, values);
}

void Tool::one_of(const std::string& names, const std::vector<std::string>& choices,
                  const std::string& help, const Set& set) {
  std::string all, type;
  for (const std::string& choice : choices) {
    all += (all.empty() ? "" : ", ") + choice;
    type += (type.empty() ? "" : ",") + choice;
  }
  add(names, '{' + type + '}', help, [choices, all, set](const std::string& text) {
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      fail("'{}' is not one of {}", shown(text), all);
    set(text);
  });
}

void Tool::body(Body& body, std::initializer_list<BodyOption> options,
                BodyUncertainty* uncertainty) {
  body = {not_given, not_given, not_given};
  BodyUncertainty* const u = uncertainty;
  for (const BodyOption option : options) switch (option) {
      case BodyOption::mass:
        number("-m,--mass", body.m, positive, "mass m [kg]");
        break;
      case BodyOption::radius:
        estimate("-R,--radius", body.R, u ? &u->R : nullptr, positive, "radius R [m]");
        break;
      case BodyOption::shape_factor:
        estimate("-K,--shape-factor", body.K, u ? &u->K : nullptr, not_negative,
                 "shape factor K of J = K m R^2");
        break;
      case BodyOption::gravity:
        estimate("-g,--gravity", body.g, u ? &u->g : nullptr, positive, "gravity g [m/s^2] (9.81)");
        break;
      case BodyOption::slope:
        estimate("--slope", body.slope, u ? &u->slope : nullptr, any_number,
                 "rise of the mat in metres per metre of growing x (0)");
        break;
    }
}

void Tool::law(PowerLaw& law) {
  law = {not_given, not_given};
  number("-a,--coefficient", law.a, positive, "coefficient a of the law D = a v^b [m (s/m)^b]");
  number("-b,--exponent", law.b, any_number, "exponent b of the law");
}

void Tool::geometry(Geometry& geometry) {
  geometry = Geometry::approximate;
  add_flag("--exact", "keep A = sqrt(1 - D^2/R^2) (the paper sets A = 1)",
           [&geometry](bool on) { geometry = on ? Geometry::exact : Geometry::approximate; });
}

void Tool::scene() {
  text("--scene", scene_file_, "FILE",
       "TOML file with the long names of a scene's options; the command line wins");
}

void Tool::input() {
  command_line_.operands("input files, read in order; - or none is standard input", input_.files);
  list("--use", input_.use, "NAME=COLUMN",
       "the column (a name or a number from 1) that serves as t, x, v, a or D");
  add("--run", "N", "read this run only: by the number in its header, else by its place",
      [this](const std::string& text) { input_.run = static_cast<int>(to_number(text, whole)); });
  flag("--strict", input_.strict, "a missing reading is an error");
}

void Tool::output() {
  add("--digits", "N", "round computed numbers to this many significant digits",
      [this](const std::string& text) {
    out.digits = static_cast<int>(to_number(text, {"a whole number from 1 to 17", [](double x) {
                                                     return x >= 1 && x <= 17 && x == std::floor(x);
                                                   }}));
  });
  flag("-u,--unbuffered", out.unbuffered, "write each record at once");
}

/// Sets the options that are not on the command line from the scene file; ignores keys without an
/// option in this tool.
void Tool::take_scene() {
  if (scene_file_.empty()) return;
  refuse_output(scene_file_);
  for (const SceneValue& scene : read_scene(scene_file_)) {
    const auto option = options_.find(scene.key);
    if (option == options_.end() || on_command_line(scene.key)) continue;
    try {
      option->second.set(scene.value);
      in_scene_.insert(scene.key);
    } catch (const Error& error) {
      fail("{}:{}: {}: {}", scene_file_, scene.line, scene.key, error.what());
    }
  }
}

bool Tool::used(const std::string& quantity) const {
  return std::any_of(input_.use.begin(), input_.use.end(),
                     [&](const std::string& use) { return use.starts_with(quantity + '='); });
}

Reader& Tool::read(std::vector<std::string> order) {
  const bool standard_input =
      input_.files.empty() ||
      std::find(input_.files.begin(), input_.files.end(), "-") != input_.files.end();
  if (standard_input && ::isatty(STDIN_FILENO))
    say("reading columns from the terminal; end with Ctrl-D");
  return open(input_, std::move(order));
}

Reader& Tool::read_file(const std::string& file, std::vector<std::string> order) {
  ReaderOptions options{{file}, {}, {}, input_.strict};
  options.has_use = false;  // --use is about the operands
  return open(std::move(options), std::move(order));
}

Reader& Tool::open(ReaderOptions options, std::vector<std::string> order) {
  const auto& files = options.files;
  if ((files.empty() || std::find(files.begin(), files.end(), "-") != files.end()) &&
      std::exchange(standard_input_taken_, true))
    fail("standard input cannot be read twice: name a file for one of the two");
  options.on_block = [this](const std::string& name, double part) {
    progress.at(name == "-" ? "standard input" : name, part);
  };
  return *readers_.emplace_back(std::make_unique<Reader>(std::move(options), std::move(order)));
}

void Tool::need(const std::vector<std::string>& options) const {
  std::vector<std::string> missing;
  for (const std::string& option : options)
    if (options_.at(option).missing()) missing.push_back("--" + option);
  if (missing.size() == 1) fail("{} is not given, nor is it in a scene", missing.front());
  if (missing.size() > 1) fail("{} are not given, nor are they in a scene", enumeration(missing));
}

void Tool::say(const std::string& text) {
  progress.stop();
  write_line(name_, text);
}

void Tool::count_left_out(std::size_t count, const std::string& why) {
  if (count > 0 && !quiet_)
    say(fmt::format("{} record{} left out: {}", count, count == 1 ? "" : "s", why));
}

namespace {

// The last line of the output after a signal; static because a signal handler has no arguments.
std::array<char, 128> last_line;
std::size_t last_line_size = 0;
const Output* printed = nullptr;

/// The signal handler: writes the last line, unless standard output would block, and ends the tool
/// by the same signal. Output::flush() blocks signals, so the output ends with a whole line.
void end_by_signal(int signal) {
  pollfd ready{STDOUT_FILENO, POLLOUT, 0};
  if (printed->has_printed() && ::poll(&ready, 1, 0) == 1 && (ready.revents & POLLOUT) != 0) {
    [[maybe_unused]] const auto count = ::write(STDOUT_FILENO, last_line.data(), last_line_size);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

/// Installs the handler. Signals that the caller has set to be ignored stay ignored.
void Tool::handle_signals() {
  error_line_ = error_line(name_);
  if (error_line_.size() >= last_line.size()) return;
  last_line_size = error_line_.copy(last_line.data(), last_line.size());
  last_line[last_line_size++] = '\n';
  printed = &out;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

void Tool::check_failed(const std::string& text) {
  if (failed_checks_++ == 0) failed_check_ = text;
}

/// Flushes the output and prints the counts and failed checks; returns the exit status.
int Tool::finish(int status) {
  if (status == trouble) out.end_with(error_line_);
  out.flush();
  progress.stop();
  std::size_t left_out = 0;
  bool coarse_time = false;
  for (const auto& reader : readers_) {
    left_out += reader->left_out();
    coarse_time |= reader->coarse_time();
  }
  if (coarse_time && !quiet_)
    say("the times are so large that the time between records keeps fewer than four digits; "
        "subtract the first");
  count_left_out(left_out, "a reading is missing");
  if (failed_checks_ == 0) return status;
  say(failed_checks_ == 1 ? failed_check_
                          : fmt::format("{} (and {} more)", failed_check_, failed_checks_ - 1));
  return 1;
}

int Tool::run(int argc, char** argv, const std::function<int()>& work) {
  if (argc > 0) name_ = argv[0];  // PROGRAM_PREFIX in the Makefile may have renamed the tool
  name_.erase(0, name_.rfind('/') + 1);
  // A write beyond the limit of the file size then fails, which flush() reports.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    handle_signals();
    switch (command_line_.parse(argc, argv)) {
      case CommandLine::Asked::help: {
        const std::string text = command_line_.help(name_);
        // CLI11 writes into streams, which lose text silently when memory runs out.
        if (text != command_line_.help(name_)) throw std::bad_alloc();
        return print(text);
      }
      case CommandLine::Asked::version:
        return print(fmt::format("{} (rolling) {}\n", name_, version));
      case CommandLine::Asked::work:
        break;
    }
    take_scene();
    if (!quiet_) progress.start(name_);
    if (::isatty(STDOUT_FILENO))
      out.before_write = [this] { progress.stop(); };  // rows on the terminal show the progress
    return finish(work());
  } catch (const OutputError& error) {
    say(error.what());
  } catch (const Error& error) {
    const bool located = dynamic_cast<const InputError*>(&error) || readers_.empty() ||
                         readers_.back()->where().empty();
    say(located ? error.what() : readers_.back()->where() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  }
  // The records before the error remain; this line tells the next tool of a pipe that it ended.
  out.end_with(error_line_);
  return trouble;
}

/// Writes `text` to standard output; returns the exit status.
int Tool::print(const std::string& text) {
  try {
    out.text(text);
    out.flush();
    return 0;
  } catch (const Error& error) {
    say(error.what());
    return trouble;
  }
}

}  // namespace rolling
