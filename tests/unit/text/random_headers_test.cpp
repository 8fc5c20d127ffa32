// SPDX-License-Identifier: GPL-3.0-or-later
// Random headers: colons, brackets, second clocks, other languages, runs side by side. Each is read
// as an independent reader says, which knows the columns from how they were made, or refused.

#include <algorithm>
#include <cmath>
#include <random>

#include "unit/text/rows.h"

using namespace rolling;

namespace {

/// A column as it was made: what it is, and the size of its unit.
struct Made {
  std::string name;
  char is;  // t or v; c: a second clock; -: neither
  double size = 1;
  int run = 0;  // of those side by side; 0 belongs to all
};

class RandomHeader {
 public:
  explicit RandomHeader(unsigned seed) : random_(seed) { make(); }
  std::string text;
  std::vector<std::array<double, 2>> rows;  // t and v of all runs, in order
  bool question = false;                    // there is a second clock

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  template <typename T>
  const T& one_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }
  struct Unit {
    const char* text;
    double size;
  };
  Unit time_unit() {
    return one_of<Unit>({{"s", 1},
                         {"ms", 1e-3},
                         {"in s", 1},
                         {"seconds", 1},
                         {"msec", 1e-3},
                         {"min", 60},
                         {"Minutes", 60}});
  }
  Unit speed_unit() {
    return one_of<Unit>({{"m/s", 1},
                         {"km/h", 1 / 3.6},
                         {"cm/s", 0.01},
                         {"ms-1", 1},
                         {"m s^-1", 1},
                         {"kmph", 1 / 3.6},
                         {"meters per second", 1},
                         {"in cm/s", 0.01},
                         {"mph", 0.44704}});
  }
  /// A column that no tool takes for t or v.
  std::string other(bool speeds) {
    std::vector<std::string> names = {
        "Clock (hh:mm:ss)", "Ratio (in:out)", "lat (deg:min)", "Unnamed: 0",   "Engine: Load (%)",
        "GPS: Satellites",  "Kraft (N)",      "force",         "Temp. (C)",    "n (1/min)",
        "Winkel (deg)",     "F: max (N)",     "Runtime error", "Lifetime (%)", "v_in[m/s]x"};
    if (speeds) names.push_back("Wheel Speed (m/s)");  // beside one that is named v
    return one_of(names);
  }

  void make() {
    const std::string separator = one_of<std::string>({",", ";", "\t"});
    const bool foreign = below(3) == 0;
    const Unit t = time_unit(), v = speed_unit();
    const std::size_t runs = foreign ? 1 : one_of<std::size_t>({1, 1, 2, 3});
    const bool own_times = runs > 1 && below(2) == 0;
    const std::string style = one_of<std::string>({"Run #", "Run ", "Data Set "});
    std::vector<Made> columns;
    const auto add = [&](const std::string& name, char is, const Unit& unit, int run) {
      std::string full = name + " (" + unit.text + ")";
      if (run > 0 && style == "Data Set ") full = style + std::to_string(2 * run) + ": " + full;
      else if (run > 0) full += " " + style + std::to_string(2 * run);
      columns.push_back({full, is, unit.size, run});
    };
    const std::string time = one_of<std::string>(
                          foreign ? std::vector<std::string>{"Zeit", "temps",
                                                             "\xE6\x97\xB6\xE9\x97\xB4"}
                                  : std::vector<std::string>{"Time", "t", "TIME"}),
                      speed = one_of<std::string>(
                          foreign ? std::vector<std::string>{"Geschwindigkeit", "vitesse"}
                                  : std::vector<std::string>{"Velocity", "v", "Speed"});
    if (runs == 1 || !own_times) add(time, 't', t, 0);
    for (std::size_t run = 1; run <= runs; ++run) {
      const int label = runs == 1 ? 0 : static_cast<int>(run);
      if (own_times) add(time, 't', t, label);
      add(speed, 'v', v, label);
    }
    if (below(4) == 0) {
      columns.push_back({one_of<std::string>({"Time (velocity) (s)", "Time 2 (s)", "GPS Time (s)",
                                              "GPS-Time", "t2 (s)", "Time (s).1", "Uhr (s)"}),
                         'c'});
      question = true;
    }
    for (std::size_t n = below(4); n > 0; --n) {
      const std::string name = other(!foreign);
      if (std::ranges::none_of(columns, [&](const Made& made) { return made.name == name; }))
        columns.push_back({name, '-'});
    }
    if (runs == 1) std::ranges::shuffle(columns, random_);
    write(columns, separator, runs);
  }

  void write(const std::vector<Made>& columns, const std::string& separator, std::size_t runs) {
    for (const Made& of : columns) text += (text.empty() ? "" : separator) + of.name;
    text += '\n';
    std::vector<std::vector<std::array<double, 2>>> found(runs);
    for (int row = 0; row < 3; ++row) {
      std::vector<std::array<double, 2>> at(runs);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const int number = 7 * (row + 1) + static_cast<int>(c);
        text += fmt::format("{}{}", c ? separator : "", number);
        for (std::size_t run = 0; run < runs; ++run)
          if (columns[c].run == 0 || columns[c].run == static_cast<int>(run) + 1) {
            if (columns[c].is == 't') at[run][0] = number * columns[c].size;
            if (columns[c].is == 'v') at[run][1] = number * columns[c].size;
          }
      }
      text += '\n';
      for (std::size_t run = 0; run < runs; ++run) found[run].push_back(at[run]);
    }
    for (const auto& run : found) rows.insert(rows.end(), run.begin(), run.end());
  }

  std::mt19937_64 random_;
};

}  // namespace

TEST_CASE("random headers: every run and unit as an independent reader says, or refused",
          "[text]") {
  std::size_t read = 0, refused = 0;
  for (unsigned seed = 1; seed <= 4000; ++seed) {
    const RandomHeader made(seed);
    const TemporaryFile file(made.text);
    std::vector<std::array<double, 2>> found;
    const std::string message = refusal([&] {
      Reader in({.files = {file.name()}}, {"t", "v"});
      const std::size_t t = in.need("t"), v = in.need("v");
      while (in.next_run())
        while (in.next()) found.push_back({in[t], in[v]});
    });
    INFO(seed << ":\n" << made.text << message);
    if (!message.empty()) {
      ++refused;
      // Nothing else is a question in these headers.
      CHECK(made.question);
      continue;
    }
    ++read;
    CHECK_FALSE(made.question);
    bool same = found.size() == made.rows.size();
    for (std::size_t i = 0; same && i < found.size(); ++i)
      for (const std::size_t k : {0u, 1u})
        same = same && std::abs(found[i][k] / made.rows[i][k] - 1) < 1e-12;
    CHECK(same);
  }
  CHECK(read > 2 * refused);
}
