// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/head.h"

#include <fmt/format.h>

#include <algorithm>

#include "text/number.h"
#include "unit/text/files.h"

using namespace rolling;

namespace {

std::string in_brackets(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns) text += '<' + column.written + '>';
  return text;
}

/// A line with a field for each of so many columns.
std::string line_of(const std::string& field, std::size_t columns) {
  std::string line = field;
  for (std::size_t i = 1; i < columns; ++i) line += '\t' + field;
  return line + '\n';
}

/// The names that are chosen among comments on the lines 1, 2, ... above the first row or, if not
/// `first`, above that of a second run; or what refuses them.
std::string chosen(const std::vector<std::string>& comments, const UnnamedColumns& columns,
                   bool first = true) {
  std::string text;
  for (const Column& column : columns.before) text += (text.empty() ? "" : "\t") + column.name;
  if (!first) text += '\n' + line_of("0", columns.count) + '\n';
  const auto above = std::ranges::count(text, '\n');
  for (const std::string& comment : comments) text += comment + '\n';
  text += line_of("0", columns.count - columns.blank_end);
  if (columns.blank_end) text.insert(text.size() - 1, "\t");
  const TemporaryFile file(text);
  std::string all;
  const std::string message = refusal([&] {
    Lines lines(file.name());
    Dialect dialect;
    Head head = read_head(lines, dialect, nullptr, {}, Sides::by_names);
    if (!first) {
      lines.next();
      const Head before = head;
      head = read_head(lines, dialect, &before, {}, Sides::by_names);
    }
    const auto line = static_cast<std::ptrdiff_t>(head.line) - above;
    if (line <= std::ssize(comments))
      all = fmt::format("{} {}", line, in_brackets(head.layout.runs.front().columns));
  });
  if (message.empty()) return all;
  const std::string place = message.substr(file.name().size() + 1);
  return fmt::format("f:{}{}", std::stol(place) - above, place.substr(place.find(':')));
}

/// What refuses a comment on this line.
std::string refused(int line, const std::string& comment, std::size_t columns) {
  return fmt::format(
      "f:{}: '{}' may be the names of the columns, or a sentence: put tabs between names, one for "
      "each of {} columns, behind one #; or give the sentence another number of words",
      line, comment, columns);
}

}  // namespace

TEST_CASE("commented names: the names in a comment, and what speaks for them", "[text]") {
  const auto names = [](std::string_view comment, std::size_t width, bool blank_end = false) {
    const Names of = names_in_comment(comment, {width, blank_end, {{"w"}}});
    return fmt::format("{}{}{}", of.separator == '\t' && width > 1 ? "tabs " : "",
                       of.known ? fmt::format("{} ", of.known) : "", in_brackets(of.columns));
  };
  CHECK(names("# p\tq", 2) == "tabs <p><q>");
  CHECK(names("# p q", 2) == "<p><q>");
  CHECK(names("# p, w[m]", 2) == "1 <p><w[m]>");
  CHECK(names("#t (s)\tp q", 2) == "tabs 1 <t (s)><p q>");
  CHECK(names("#\tp", 2) == "tabs <><p>");
  CHECK(names("#\tp", 1) == "<p>");  // one column has no tabs between columns
  CHECK(names("# p q\t", 1) == "<p q>");
  CHECK(names("# p, w[m],,", 2) == "1 <p><w[m]>");
  CHECK(names("#;p;w[m]", 2) == "1 <p><w[m]>");
  CHECK(names("#;p;w[m]", 3) == "1 <><p><w[m]>");
  CHECK(names("# a second run", 3) == "<a><second><run>");
  CHECK(names("# v a second", 3) == "1 <v><a><second>");
  CHECK(names("# n a", 2) == "<n><a>");
  CHECK(names("# t b x D", 4) == "3 <t><b><x><D>");
  CHECK(names("# a sigma_a", 2) == "<a><sigma_a>");
  CHECK(names("# a, second", 2) == "1 <a><second>");
  CHECK(names("# \"t (min)\"; \"v\"", 3, true) == "2 <t (min)><v>");
  CHECK(names("# \"t, of the clock (s)\",\"v\"", 2) == "1 <t, of the clock (s)><v>");
  CHECK(names("# a b", 3).empty());
  CHECK(names("## t v", 2) == "2 <t><v>");
  CHECK(names("# t v", 3, true) == "2 <t><v>");
  CHECK(names("# p q", 3, true) == "<p><q>");
}

TEST_CASE("commented names: the last comment with known names, else the last with words",
          "[text]") {
  CHECK(chosen({"# t x", "# made by me", "# v t"}, {2}) == "3 <v><t>");
  CHECK(chosen({"# v t", "# made by me", "# made today"}, {2}) == "1 <v><t>");
  CHECK(chosen({"# pushed at t", "# n t v"}, {3}) == "2 <n><t><v>");
  CHECK(chosen({"# made today", "# p\tq"}, {2}) == "2 <p><q>");
  CHECK(chosen({"# Time (s), Velocity (m/s)", "# t v"}, {2}) == "2 <t><v>");
  CHECK(chosen({"# p q", "# 12:30 2"}, {2}) == "1 <p><q>");
  CHECK(chosen({"# p q"}, {2}, false).empty());
  CHECK(chosen({"# w q"}, {2, false, {{"w"}, {"n"}}}, false) == "1 <w><q>");
  CHECK(chosen({"# t v"}, {3, true}) == "1 <t><v>");
  CHECK(chosen({}, {2}).empty());
  CHECK(chosen({"# t,v"}, {2}) == "1 <t><v>");
  CHECK(chosen({"# t v,"}, {2}) == "1 <t><v>");
}

TEST_CASE(
    "commented names: behind a run, words that would move its known columns may be a sentence",
    "[text]") {
  const std::vector<Column> before{{"t"}, {"v"}, {"w"}};
  CHECK(chosen({"# t has v"}, {3, false, before}, false) == refused(1, "# t has v", 3));
  CHECK(chosen({"# was pushed to"}, {3, false, before}, false).empty());
  CHECK(chosen({"# t v n"}, {3, false, before}, false) == "1 <t><v><n>");
  CHECK(chosen({"# t, n, v"}, {3, false, before}, false) == "1 <t><n><v>");
  CHECK(chosen({"# v t"}, {2, false, {{"t"}, {"v"}}}, false) == "1 <v><t>");
}

TEST_CASE("commented names: a comment with more known names than the chosen one is no remark",
          "[text]") {
  CHECK(chosen({"# t x v", "# v before t"}, {3}) == refused(1, "# t x v", 3));
  CHECK(chosen({"# n t v", "# v or t"}, {3}) == refused(1, "# n t v", 3));
  CHECK(chosen({"# trial D", "# t angle"}, {2}) == refused(1, "# trial D", 2));
  CHECK(chosen({"# trial D", "# t\tangle"}, {2}) == "2 <t><angle>");
}

TEST_CASE("commented names: names of columns in a history line are refused", "[text]") {
  for (const char* line :
       {"## t[s] x[cm]", "##Time (s),Position (cm)", "## t x v", "###w;x;v", "## x,v"})
    CHECK(chosen({"# made by me", line}, {3}) == refused(2, line, 3));
  CHECK(chosen({"## t[ms] n v[m/s] x", "# v Time Monday test"}, {4}) ==
        refused(1, "## t[ms] n v[m/s] x", 4));
  CHECK(chosen({"## t x v"}, {5}) == refused(1, "## t x v", 5));
  CHECK(chosen({"## smooth v coast", "## smooth v mean width 3"}, {3}).empty());
  CHECK(chosen({"## t x v", "# v x t"}, {3}) == "2 <v><x><t>");
  CHECK(chosen({"## t x v", "# t x v"}, {3}) == "2 <t><x><v>");
}

TEST_CASE("commented names: nothing but known quantities, but not one for each column", "[text]") {
  // Such are the names of a file of which columns were cut away, or added.
  for (const std::string text : {"#v[mm/s]", "# t x v", "# t[s]\tx", "# Time (s), v, a"})
    for (const std::size_t columns : {4U, 5U})
      for (const bool first : {true, false})
        CHECK(chosen({text}, {columns}, first) == refused(1, shown(text), columns));
  CHECK(chosen({"#v[mm/s]", "# t x"}, {2}) == "2 <t><x>");
  CHECK(chosen({"# a;v;t", "# cart v t run"}, {4}) == refused(1, "# a;v;t", 4));
  CHECK(chosen({"# v t", "# n\ta\tv\tt"}, {4}) == "2 <n><a><v><t>");
  CHECK(chosen({"# v", "# the v", "# v, fast", "#", "# 5"}, {3}).empty());
}

TEST_CASE("commented names: a comment with units and names of other columns is refused", "[text]") {
  CHECK(chosen({"# t [ms]: time, x [cm]"}, {3}) == refused(1, "# t [ms]: time, x [cm]", 3));
  for (const char* comment : {"# Time (s); Position (m)", "#,t[s],w,x[m]", "# w[N]\tt[s]; x[m]"})
    CHECK(chosen({comment}, {5}) == refused(1, shown(comment), 5));
  for (const char* comment : {"# t[s] alone now", "# w[ms] n[cm]", "# t in s, v in m/s", "##"})
    CHECK(chosen({comment}, {4}, false).empty());
}
