#include "cli/tool.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "text/number.h"

namespace rolling {
namespace {

constexpr std::string_view version = "1.0.0";
constexpr int trouble = 2;  // the exit status

/// The numbers of a scene: what its file may say, whether or not a tool needs it.
constexpr std::array scene_keys = {"mass",        "radius",   "shape-factor", "gravity",
                                   "coefficient", "exponent", "exact",        "v0",
                                   "x0",          "memory",   "damping",      "slope"};

double to_number(const std::string& option, const std::string& text, const Range& range) {
  double value;
  if (!parse_number(text, value)) fail("{}: '{}' is not a number", option, shown(text));
  if (!range.holds(value)) fail("{}: '{}' must be {}", option, shown(text), range.text);
  return value;
}

/// One line of printable ASCII on standard error, at most 512 bytes. Needs no memory: that may be
/// what has run out.
void write_line(std::string_view name, std::string_view text) {
  std::array<char, 512> line;
  char* const end = fmt::format_to_n(line.data(), line.size() - 1, "{}: {}", name, text).out;
  std::replace_if(
      line.data(), end, [](char c) { return c < ' ' || c > '~'; }, '?');
  *end = '\n';
  [[maybe_unused]] const auto count = ::write(
      STDERR_FILENO, line.data(),
      static_cast<std::size_t>(end + 1 - line.data()));  // where could one say that it failed?
}

/// What is thrown where nothing catches: before main(), by a static object, or while a message is
/// being made.
[[noreturn]] void last_words() {
  const char* what = "unknown trouble";
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

/// Ahead of all static objects.
[[gnu::constructor(101)]] void set_last_words() { std::set_terminate(last_words); }

std::string long_name(const std::string& names) {
  const auto at = names.find("--");
  return at == std::string::npos ? std::string() : names.substr(at + 2);
}

}  // namespace

Tool::Tool(std::string name, const std::string& purpose)
    : name_(std::move(name)), app_(purpose, name_) {
  app_.set_help_flag("-h,--help", "print this and exit")->disable_flag_override();
  app_.set_version_flag(
          "--version", [this] { return fmt::format("{} (rolling) {}", name_, version); },
          "print the version and exit")
      ->disable_flag_override();
  flag("-q,--quiet", quiet_, "neither counts of left-out records nor progress on standard error");
}

void Tool::add(const std::string& names, const std::string& type, const std::string& help,
               const std::function<void(const std::string&)>& set) {
  setters_[long_name(names)] = set;
  app_.add_option_function<std::string>(names, set, help)->type_name(type);
}

void Tool::add_flag(const std::string& names, const std::string& help,
                    const std::function<void(bool)>& set) {
  setters_[long_name(names)] = [set, names](const std::string& text) {
    if (text != "true" && text != "false")
      fail("{}: '{}' is neither true nor false", names, shown(text));
    set(text == "true");
  };
  app_.add_flag_function(
          names, [set](std::int64_t) { set(true); }, help)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
      ->disable_flag_override();
}

void Tool::flag(const std::string& names, bool& value, const std::string& help) {
  add_flag(names, help, [&value](bool on) { value = on; });
}

void Tool::number(const std::string& names, double& value, const Range& range,
                  const std::string& help) {
  add(names, "NUMBER", help,
      [&value, range, names](const std::string& text) { value = to_number(names, text, range); });
}

void Tool::count(const std::string& names, std::size_t& value, const Range& range,
                 const std::string& help) {
  add(names, "N", help, [&value, range, names](const std::string& text) {
    value = static_cast<std::size_t>(to_number(names, text, range));
  });
}

void Tool::numbers(const std::string& names, std::vector<double>& values, const Range& range,
                   const std::string& help) {
  add(names, "NUMBER,...", help, [&values, range, names](const std::string& text) {
    values.clear();
    for (const std::string& part : split_names(text, ','))
      values.push_back(to_number(names, part, range));
  });
}

void Tool::text(const std::string& names, std::string& value, const std::string& type,
                const std::string& help) {
  add(names, type, help, [&value, names](const std::string& text) {
    if (text.empty()) fail("{}: '' is no value", names);
    value = text;
  });
}

void Tool::list(const std::string& names, std::vector<std::string>& values, const std::string& type,
                const std::string& help) {
  app_.add_option(names, values, help)->allow_extra_args(false)->type_name(type);
}

void Tool::body(Body& body, const std::string& which) {
  body = {not_given, not_given, not_given, 9.81};
  if (which.find('m') != std::string::npos) number("-m,--mass", body.m, positive, "mass m [kg]");
  if (which.find('R') != std::string::npos) number("-R,--radius", body.R, positive, "radius R [m]");
  if (which.find('K') != std::string::npos)
    number("-K,--shape-factor", body.K, not_negative, "shape factor K of J = K m R^2");
  if (which.find('g') != std::string::npos)
    number("-g,--gravity", body.g, positive, "gravity g [m/s^2] (9.81)");
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
  app_.add_option("FILE", input_.files, "input files, read in order; - or none is standard input");
  list("--use", input_.use, "NAME=COLUMN",
       "the column (a name or a number from 1) that serves as t, x, v, a or D");
  add("--run", "N", "read this run only: the number in its header, else its place",
      [this](const std::string& text) {
    input_.run = static_cast<int>(to_number("--run", text, whole));
  });
  flag("--strict", input_.strict, "a missing reading is an error");
}

void Tool::output() {
  add("--digits", "N", "round computed numbers to this many significant digits",
      [this](const std::string& text) {
    out.digits = static_cast<int>(
        to_number("--digits", text, {"a whole number from 1 to 17", [](double x) {
                                       return x >= 1 && x <= 17 && x == std::floor(x);
                                     }}));
  });
  flag("-u,--unbuffered", out.unbuffered, "let each record go out at once");
}

/// Sets what the command line has left open from the scene file.
void Tool::read_scene() {
  if (scene_file_.empty()) return;
  std::ifstream file(scene_file_);
  if (!file) fail("{}: {}", scene_file_, std::strerror(errno));
  const std::vector<CLI::ConfigItem> items = CLI::ConfigTOML().from_config(file);
  if (file.bad()) fail("{}: {}", scene_file_, std::strerror(errno));
  std::vector<std::string> seen;
  for (const CLI::ConfigItem& item : items) {
    const std::string key = item.fullname();
    if (std::find(scene_keys.begin(), scene_keys.end(), key) == scene_keys.end())
      fail("{}: '{}' is not a number of a scene (mass, radius, shape-factor, ...)", scene_file_,
           shown(key));
    if (item.inputs.size() != 1 || std::find(seen.begin(), seen.end(), key) != seen.end())
      fail("{}: {} needs one value", scene_file_, key);
    seen.push_back(key);
    const auto setter = setters_.find(key);
    if (setter == setters_.end() || on_command_line(key)) continue;
    try {
      setter->second(item.inputs.front());
    } catch (const Error& error) {
      fail("{}: {}", scene_file_, error.what());
    }
  }
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
  return open({{file}, {}, {}, input_.strict}, std::move(order));
}

Reader& Tool::open(ReaderOptions options, std::vector<std::string> order) {
  options.on_block = [this](const std::string& name, double part) {
    progress.at(name == "-" ? "standard input" : name, part);
  };
  return *readers_.emplace_back(std::make_unique<Reader>(std::move(options), std::move(order)));
}

/// What --help prints, from the options as CLI11 holds them; cmd/install/completion.awk reads it.
std::string Tool::help() const {
  constexpr std::size_t width = 79, indent = 30;
  std::string text, operands = "\n", options = "\nOptions:\n";
  const auto item = [](std::string& to, const std::string& names, std::string_view words) {
    std::string line = "  " + names;
    if (line.size() + 2 > indent) to += line + '\n', line.clear();
    line.resize(indent, ' ');
    while (line.size() + words.size() > width) {
      const std::size_t blank = words.rfind(' ', width - line.size());
      (to += line) += words.substr(0, blank);
      to += '\n';
      line.assign(indent, ' ');
      words.remove_prefix(blank + 1);
    }
    ((to += line) += words) += '\n';
  };
  for (const CLI::Option* option : app_.get_options()) {
    if (!option->nonpositional()) {
      item(operands, option->get_name() + "...", option->get_description());
      continue;
    }
    std::string names;
    for (const std::string& name : option->get_snames()) names += '-' + name + ',';
    names += "--" + option->get_lnames().front();
    if (option->get_type_size() > 0) names += ' ' + option->get_type_name();
    if (option->get_type_size() > 0 && option->get_items_expected_max() > 1) names += " ...";
    item(options, names, option->get_description());
  }
  const bool reads = operands.size() > 1;
  return fmt::format("Usage: {} [OPTION...]{}\n", name_, reads ? " [FILE...]" : "") +
         app_.get_description() + '\n' + (reads ? operands : "") + options;
}

void Tool::need(double value, const std::string& option) const {
  if (std::isnan(value)) fail("{} is not given, nor is it in a scene", option);
}

void Tool::need(const Body& body, const std::string& which) const {
  for (const char c : which) {  // g has a default
    if (c == 'm') need(body.m, "--mass");
    if (c == 'R') need(body.R, "--radius");
    if (c == 'K') need(body.K, "--shape-factor");
  }
}

void Tool::need(const PowerLaw& law) const {
  need(law.a, "--coefficient");
  need(law.b, "--exponent");
}

void Tool::say(const std::string& text) {
  progress.stop();
  write_line(name_, text);
}

void Tool::count_left_out(std::size_t count, const std::string& why) {
  if (count > 0 && !quiet_)
    say(fmt::format("{} record{} left out: {}", count, count == 1 ? "" : "s", why));
}

int Tool::run(int argc, char** argv, const std::function<int()>& work) {
  if (argc > 0) name_ = argv[0];  // as it is installed: see PROGRAM_PREFIX in the Makefile
  name_.erase(0, name_.rfind('/') + 1);
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is one that cannot be written: told by flush()
  try {
    app_.parse(argc, argv);
    read_scene();
    if (!quiet_) progress.start(name_);
    if (::isatty(STDOUT_FILENO))
      out.before_write = [this] { progress.stop(); };  // rows are progress enough
    const int status = work();
    out.flush();
    progress.stop();
    std::size_t left_out = 0;
    bool coarse_time = false;
    for (const auto& reader : readers_)
      left_out += reader->left_out(), coarse_time |= reader->coarse_time();
    if (coarse_time && !quiet_)
      say("the times are so large that the time between records keeps fewer than four digits; "
          "subtract the first");
    count_left_out(left_out, "a reading is missing");
    return status;
  } catch (const CLI::CallForHelp&) {
    const std::string text = help();
    if (text != help())
      throw std::bad_alloc();  // CLI11 writes it into streams, which are silent when memory runs
                               // out
    return print(text);
  } catch (const CLI::CallForVersion& call) {
    return print(std::string(call.what()) + '\n');
  } catch (const CLI::ParseError& error) {
    std::string text;
    for (const std::string& word : split_names(error.what(), '\0')) text += shown(word) + ' ';
    say(text + "(see --help)");
  } catch (const OutputError& error) {
    say(error.what());
  } catch (const Error& error) {
    out.drop_line();  // what came before the bad record may stand; the line in the making may not
    print("");
    const bool located = dynamic_cast<const InputError*>(&error) || readers_.empty() ||
                         readers_.back()->where().empty();
    say(located ? error.what() : readers_.back()->where() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  }
  return trouble;
}

/// Writes what is due and `text`; returns the exit status.
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
