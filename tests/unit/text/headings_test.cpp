// SPDX-License-Identifier: GPL-3.0-or-later
// Files of random headings, comments and separators: t and v are read as they were written, or the
// file is refused. What would be a fault is another column, or another unit, without a word.

#include <algorithm>
#include <array>
#include <random>

#include "text/number.h"
#include "unit/text/rows.h"

using namespace rolling;

namespace {

/// A random file of one run or more, of three rows with a t and a v each, and what these are in
/// SI units.
class RandomFile {
 public:
  explicit RandomFile(unsigned seed) : random_(seed) { make(); }
  std::string text;
  std::vector<std::array<double, 2>> rows;

 private:
  struct Unit {
    const char* text;
    double size;
  };
  struct Made {
    std::string name, unit;
    double size;
  };

  std::size_t below(std::size_t n) { return random_() % n; }
  bool once_in(std::size_t n) { return below(n) == 0; }
  template <typename T>
  const T& one_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }

  Made column(char quantity) {
    static const std::vector<Unit> times{{"s", 1}, {"ms", 1e-3}, {"min", 60}},
        lengths{{"m", 1}, {"mm", 1e-3}, {"cm", 0.01}},
        speeds{{"m/s", 1}, {"cm/s", 0.01}, {"km/h", 1 / 3.6}, {"m s^-1", 1}},
        accelerations{{"m/s^2", 1}, {"cm/s^2", 0.01}};
    switch (quantity) {
      case 't':
        return named({"t", "Time"}, one_of(times));
      case 'v':
        return named({"v", "Velocity", "Speed"}, one_of(speeds));
      case 'x':
        return named({"x", "Position"}, one_of(lengths));
      case 'a':
        return named({"a", "Acceleration"}, one_of(accelerations));
      case 'D':
        return named({"D"}, one_of(lengths));
      default:
        return {one_of<std::string>({"n", "force", "run_2", "T1", "remark", "y"}), "", 1};
    }
  }
  Made named(const std::vector<std::string>& names, const Unit& unit) {
    // A column without a unit is in SI units.
    if (unit.size == 1 && once_in(3)) return {one_of(names), "", 1};
    return {one_of(names), unit.text, unit.size};
  }

  /// The names in one line, with their units if these do not stand in a line of their own.
  std::string heading(const std::vector<Made>& columns, const std::string& separator, bool units) {
    const std::string left = one_of<std::string>({"[", " [", " (", "("});
    std::string line;
    for (const Made& of : columns) {
      if (!line.empty()) line += separator;
      line += of.name;
      if (units && !of.unit.empty())
        line += left + of.unit + (left.find('[') == std::string::npos ? ")" : "]");
    }
    return line;
  }
  /// A sentence; some words of it may be names of quantities.
  std::string prose(int named_at_most = 2) {
    static const std::vector<std::string> quantities{"a", "v", "t", "x", "D", "Time"},
        words{"the", "cart", "was",  "pushed", "at", "and", "test",   "of",    "run",
              "2",   "mat",  "soft", "is",     "m",  "in",  "Monday", "rolls", "12:30"};
    std::string line = "# " + one_of(words);
    int named = 0;
    for (std::size_t n = below(5); n > 0; --n)
      line +=
          " " + (named < named_at_most && once_in(3) ? ++named, one_of(quantities) : one_of(words));
    return line + "\n";
  }

  /// The rows of a run, between these separators.
  std::string data(const std::string& quantities, const std::vector<Made>& columns,
                   const std::string& separator, const std::string& end) {
    std::string lines;
    for (int i = 0; i < 3; ++i) {
      std::array<double, 2> row{};
      for (std::size_t c = 0; c < columns.size(); ++c) {
        // Numbers grow in all columns, so that none is refused as a time.
        const int number = 7 * (i + 1) + 3 * static_cast<int>(c);
        lines += fmt::format("{}{}", c ? separator : "", number);
        if (quantities[c] == 't') row[0] = number * columns[c].size;
        if (quantities[c] == 'v') row[1] = number * columns[c].size;
      }
      lines += end + "\n";
      rows.push_back(row);
    }
    return lines;
  }

  std::string names(const std::vector<Made>& columns, const std::string& separator,
                    const std::string& end) {
    const bool apart = once_in(5);  // the units stand in a line of their own
    std::string lines = heading(
        columns, once_in(4) ? one_of<std::string>({"\t", ",", ", ", ";", " "}) : separator, !apart);
    if (once_in(4)) lines += end.empty() ? separator.substr(0, 1) : end;
    lines = one_of<std::string>({"", "# ", "#", "# ", "## "}) + lines + "\n";
    if (!apart) return lines;
    for (std::size_t c = 0; c < columns.size(); ++c)
      lines += (c ? separator : "") + (columns[c].unit.empty() ? "-" : columns[c].unit);
    return lines + end + "\n";
  }

  /// The columns of which some names are left where one column was added, or its name cut away.
  std::vector<Made> cut(std::vector<Made> columns) {
    const auto is_known = [](const Made& of) {
      return !si_unit(read_column(of.name).name).empty();
    };
    if (columns.size() > 2 && std::ranges::all_of(columns, is_known) && once_in(8))
      columns.pop_back();
    return columns;
  }

  void make() {
    std::string quantities = "tv";
    for (const char other : {'x', 'a', 'D', 'n'})
      if (once_in(3)) quantities += other;
    const std::string separator = one_of<std::string>({"\t", ",", ";", " ", ", "});
    const std::string end = once_in(6) ? std::string(1, separator[0]) : "";
    const bool behind = once_in(12);  // as `sort -r` leaves a file
    std::vector<Made> columns;
    for (int run = 0; run == 0 || once_in(3); ++run) {
      if (run > 0) text += one_of<std::string>({"\n", "\n\n", "\n## run second\n"});
      for (std::size_t n = below(3); n > 0; --n)
        text += once_in(4) ? "## smooth v mean width 3\n" : prose(behind ? 1 : 2);
      if (run == 0 || once_in(2)) {
        std::ranges::shuffle(quantities, random_);
        columns.clear();
        for (const char of : quantities) columns.push_back(column(of));
        if (!behind) text += names(cut(columns), separator, end);
        for (std::size_t n = once_in(3) && !behind ? 1 + below(2) : 0; n > 0; --n) text += prose();
      }
      text += data(quantities, columns, separator, end);
      if (behind) {
        text += names(columns, separator, end);
        return;
      }
    }
  }

  std::mt19937_64 random_;
};

}  // namespace

TEST_CASE("headings: random ones are read as they are meant, or refused", "[text]") {
  std::size_t read = 0, refused = 0;
  for (unsigned seed = 1; seed <= 20000; ++seed) {
    const RandomFile made(seed);
    const TemporaryFile file(made.text);
    std::vector<std::array<double, 2>> found;
    const std::string message = refusal([&] {
      Reader in({.files = {file.name()}}, {"t", "v"});
      const std::size_t t = in.need("t"), v = in.need("v");
      while (in.next_run())
        while (in.next()) found.push_back({in[t], in[v]});
    });
    if (!message.empty()) {
      ++refused;
      continue;
    }
    ++read;
    bool same = found.size() == made.rows.size();
    for (std::size_t i = 0; same && i < found.size(); ++i)
      for (const std::size_t k : {0u, 1u})
        same = same && std::abs(found[i][k] / made.rows[i][k] - 1) < 1e-12;
    INFO(seed << ":\n" << made.text);
    CHECK(same);
  }
  CHECK(read > refused / 2);  // else it would show little
}

TEST_CASE("reader: a unit in brackets in another line of names is told", "[text]") {
  for (const std::string unit : {"min", "h", "us", "ms"})
    for (const std::string name : {"Time ({}), v", "t[{}]\tv", "t[{}] v"}) {
      const std::string line = "t is column 1, 't', taken in s although line 1 says " + unit,
                        names = replace_all(name, {{"{}", unit}});
      CHECK(told("# " + names + "\n# t v\n0 36\n") == line);
      CHECK(told(names + "\nt v\n0 36\n") == line);
      CHECK(told("# t v\n# " + names + "\n# t[s] v\n0 36\n").empty());
    }
}
