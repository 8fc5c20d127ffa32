// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cfenv>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <map>
#include <new>
#include <utility>

#include "text/column.h"
#include "text/lines.h"

namespace rolling {

void write_message(std::string_view name, std::string_view text) {
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

void LinesOfRuns::add(const std::string& run, const std::string& text) {
  std::string alike = text;
  std::erase_if(alike, [](char c) {
    return std::string_view("0123456789.+-e").find(c) != std::string_view::npos;
  });
  auto line = std::ranges::find(lines_, alike, &Line::alike);
  if (run.empty() || line == lines_.end()) {
    lines_.push_back({text, std::move(alike), {}});
    line = lines_.end() - 1;
  }
  if (!run.empty()) line->runs.push_back(run);
}

std::vector<std::string> LinesOfRuns::all() const {
  constexpr std::size_t most = 4;  // that are named
  std::vector<std::string> all;
  for (auto [text, alike, runs] : lines_) {
    if (runs.size() > most) runs[most] = fmt::format("{} more", runs.size() - most);
    runs.resize(std::min(runs.size(), most + 1));
    if (runs.size() > 1) runs[0] += " (and " + enumeration({runs.begin() + 1, runs.end()}) + ')';
    all.push_back(runs.empty() ? text : fmt::format("run {}: {}", runs[0], text));
  }
  return all;
}

namespace {

const char* program_name() {
#if defined(__APPLE__) || defined(__FreeBSD__)
  return ::getprogname();
#else
  return program_invocation_short_name;
#endif
}

/// The terminate handler: where nothing catches an exception, before Tool::run() or while a message
/// is being made, memory has run out.
[[noreturn]] void report_uncaught() {
  write_message(program_name(), "out of memory");
  ::_exit(trouble);
}

/// Runs before the constructors of static objects.
[[gnu::constructor(101)]] void set_terminate_handler() { std::set_terminate(report_uncaught); }

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

/// From now on SIGINT, SIGTERM and SIGHUP write this line behind the output, unless nothing has
/// been printed or standard output would block, before they end the tool. Signals that the caller
/// has set to be ignored stay ignored. A line of more than 127 bytes changes nothing.
void end_output_on_signals(const Output& out, const std::string& line) {
  if (line.size() >= last_line.size()) return;
  last_line_size = line.copy(last_line.data(), line.size());
  last_line[last_line_size++] = '\n';
  printed = &out;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace

void Tool::input() {
  const auto append_to = [](std::vector<std::string>& words) {
    return [&words](const std::string& word) { words.push_back(word); };
  };
  add("FILE", "", "input files, read in order; - or none is standard input",
      append_to(input_.files), Values::many);
  add("--use", "NAME=COLUMN", "use this column (a name or a number from 1) as t, x, v, a or D",
      append_to(input_.use), Values::many);
  text("--run", input_.run, "RUN",
       "read this run only: by the number or word in its header, else by its place");
  flag("--strict", input_.strict, "a missing reading is an error");
}

void Tool::equal_times() {
  choice<EqualTimes>("--equal-times", input_.equal_times,
                     {{"first", EqualTimes::first}, {"mean", EqualTimes::mean}},
                     "make one row of the rows of one time: the first of them, or their mean");
}

void Tool::accept() {
  const auto take = [this](const std::string& run) {
    if (run.empty()) fail("'' is no value");
    accepted_.insert(run);
    unknown_.insert(run);
  };
  add("--accept", "RUN", "let this run pass the check; may be repeated", take, Values::many);
}

void Tool::output() {
  number("--digits", out.digits,
         {"a whole number from 1 to 17", [](double x) { return whole.holds(x) && x <= 17; }},
         "round computed numbers to this many significant digits");
  flag("--plain", out.plain,
       "print one table for other programs: no #, no blank lines, the run in the last column");
  flag("-u,--unbuffered", out.unbuffered, "write each row at once");
}

bool Tool::uses(const std::string& quantity) const {
  return std::ranges::any_of(input_.use, [&](const std::string& use) {
    return read_column(use.substr(0, use.find('='))).name == quantity;
  });
}

Reader& Tool::read(std::vector<std::string> order) {
  Reader& rows = open(input_, std::move(order));
  rows_ = &rows;
  return rows;
}

Reader& Tool::read_file(const std::string& file, std::vector<std::string> order) {
  // --use is about the operands
  return open({.files = {file}, .strict = input_.strict, .has_use = false}, std::move(order));
}

Reader& Tool::open(ReaderOptions options, std::vector<std::string> order) {
  const auto named = std::ranges::count(options.files, "-");
  if (named > 1) fail("standard input (-) is named twice");
  if (options.files.empty() || named > 0) {
    if (std::exchange(standard_input_taken_, true))
      fail("standard input cannot be read twice: name a file for one of the two");
    if (::isatty(STDIN_FILENO)) warn("reading columns from the terminal; end with Ctrl-D");
  }
  for (const std::string& file : options.files) refuse_misplaced(file);
  return *readers_.emplace_back(std::make_unique<Reader>(std::move(options), std::move(order)));
}

void Tool::say(const std::string& text) {
  for (const std::string& line : std::exchange(waiting_, {}).all()) write_message(name_, line);
  if (!text.empty()) write_message(name_, text);
}

void Tool::count_left_out(std::size_t count, const std::string& why) {
  if (count > 0 && !quiet_) say(fmt::format("{} left out: {}", counted(count, "row"), why));
}

namespace {

/// Streams of the standard library catch std::bad_alloc and go on, cut off, so that the failure is
/// noted where the allocation fails.
bool memory_has_run_out = false;

void note_memory_has_run_out() {
  memory_has_run_out = true;
  throw std::bad_alloc();
}

/// What a user can do about the errors of numeric code.
const std::string choose_roll =
    ": do all rows belong to one free roll that slows down (up a slope and back: --slope fit)? "
    "Choose it with smooth --coast, or with --from and --to";
const std::map<ErrorKind, std::string> ways_out{
    {NotOneRoll, choose_roll},
    {OneWay,
     ": add runs in the other direction; if some of these are, make their x fall and "
     "their v negative"},
    {LooseExponent, choose_roll + "; or fix it, --fix b=0"},
    {NoFreeRoll, ": choose the roll by its times (--from, --to)"},
    {WayBack,
     ": on a slope, --slope S or --slope fit; else the roll alone (smooth --coast, or --to)"},
    {ReadingOff,
     ": look at it, and leave it out (smooth --outliers or --from), or fit with --robust"}};

}  // namespace

std::string Tool::told(const Error& error) const {
  const auto way_out = ways_out.find(error.kind);
  if (way_out == ways_out.end()) return error.what();
  std::string text = error.what() + way_out->second;
  const auto is_coast = [](const std::string& line) {
    return line.ends_with(" coast") || line.ends_with(" rolls");
  };
  if (rows_ != nullptr && std::ranges::any_of(rows_->history(), is_coast))
    text = replace_all(text, {{"--coast, or with ", ""}, {"--coast, or ", ""}});
  if (has("slope") && given("slope"))
    text = replace_all(text, {{" (up a slope and back: --slope fit)", ""}});
  return text;
}

/// Flushes the output and prints the counts; returns the exit status.
int Tool::finish(int status) {
  if (memory_has_run_out) throw std::bad_alloc();
  if (status == trouble) out.end_with(error_line_);
  out.flush();
  say("");
  std::size_t left_out = 0;
  for (const auto& reader : readers_) {
    for (const std::string& warning : reader->warnings()) warn(warning);
    left_out += reader->left_out();
  }
  count_left_out(left_out, "a reading is missing");
  for (const std::string& run : unknown_)
    warn(fmt::format("--accept {}: there is no run of this name", shown(run)));
  return std::max(status, failed_ ? 1 : 0);  // trouble is more than a check that does not hold
}

/// The message of an error. One that names no place is about the present row, and may come from
/// columns that were taken without a name.
std::string Tool::message_of(const Error& error) const {
  const auto at_row = [](const auto& reader) { return !reader->where().empty(); };
  const auto last = std::find_if(readers_.rbegin(), readers_.rend(), at_row);
  const Reader* const reader = last == readers_.rend() ? rows_ : last->get();
  if (reader == nullptr || error.is_complete()) return told(error);
  const Reader& in = *reader;
  std::string text = in.where();
  if (!text.empty()) text += ": ";
  if (error.is_of_motion() && !in.assumed().empty())
    text += fmt::format("{} (for other columns say --use, as --use x=2): ", in.assumed());
  text += told(error);
  if (error.is_of_motion() && !fixed_values().empty())
    text += fmt::format(" (given: {})", fixed_values());
  return text;
}

int Tool::run(int argc, char** argv, const std::function<int()>& work) {
  // Denormal numbers are numbers, also where -ffast-math has linked code that makes them 0.
  std::fesetenv(FE_DFL_ENV);
  if (argc > 0) name_ = argv[0];  // PROGRAM_PREFIX in the Makefile may have renamed the tool
  name_.erase(0, name_.rfind('/') + 1);
  // A write beyond the limit of the file size then fails, which flush() reports.
  std::signal(SIGXFSZ, SIG_IGN);
  // A reader that has gone ends the tool by SIGPIPE, as usual, but after the lines that wait.
  const bool ends_by_pipe = std::signal(SIGPIPE, SIG_IGN) == SIG_DFL;
  std::set_new_handler(note_memory_has_run_out);
  try {
    error_line_ = error_line(name_);
    end_output_on_signals(out, error_line_);
    if (const std::string asked = parse(argc, argv); !asked.empty()) {
      out.text(asked);
      return finish(0);
    }
    standard_input_taken_ = take_scene();
    doubt_body();
    return finish(work());
  } catch (const Error& error) {
    if (error.kind == ReaderGone && ends_by_pipe) {
      say("");
      std::signal(SIGPIPE, SIG_DFL);
      std::raise(SIGPIPE);
    }
    // What was odd in the rows may be why no roll fits them; message_of() says what was assumed.
    if (rows_ != nullptr && error.is_of_motion())
      for (const std::string& warning : rows_->warnings())
        if (warning != rows_->assumed()) warn(warning);
    say(message_of(error));
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  }
  // The rows before the error remain; this line tells the next tool of a pipe that it ended.
  out.end_with(error_line_);
  return trouble;
}

}  // namespace rolling
