#include "text/header.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "text/number.h"

namespace rolling {
namespace {

constexpr std::size_t npos = static_cast<std::size_t>(-1);
constexpr std::size_t longest_preamble =
    100;  // lines; more without a number is not a file of columns

/// The last comment that is no history.
std::size_t last_remark(const std::vector<std::string>& comments) {
  for (std::size_t i = comments.size(); i-- > 0;)
    if (!comments[i].starts_with("##")) return i;
  return npos;
}

/// As many names as there are fields, if the comment has them.
std::vector<std::string> commented_names(std::string_view comment, const Dialect& dialect,
                                         std::size_t width) {
  for (const char separator : {'\t', dialect.separator(), '\0'})
    if (auto names = split_names(trim(comment.substr(1)), separator); names.size() == width)
      return names;
  return {};
}

/// The line is a record all of whose readings are missing: nobody names columns NaN; and blanks,
/// under names already given, are no names.
bool is_missing_record(std::string_view line, Dialect& dialect,
                       const std::vector<std::string>& comments,
                       const std::vector<std::string>& preamble) {
  const auto fields = dialect.split(line);
  if (!std::all_of(fields.begin(), fields.end(),
                   [](const Field& field) { return is_missing(field.text); }))
    return false;
  if (!std::all_of(fields.begin(), fields.end(),
                   [](const Field& field) { return field.text.empty(); }))
    return true;
  const std::size_t width = fields.size();
  if (preamble.empty())
    return last_remark(comments) != npos &&
           !commented_names(comments[last_remark(comments)], dialect, width).empty();
  const auto names = names_in(preamble.back(), dialect);
  return names.size() == width &&
         std::none_of(names.begin(), names.end(),
                      [](const std::string& name) { return name.empty(); });
}

}  // namespace

std::vector<std::string> names_in(std::string_view line, Dialect& dialect) {
  if (dialect.separator() == '\0') return split_names(line, '\0');
  std::vector<std::string> names;
  for (const Field& field : dialect.split(line)) names.emplace_back(field.text);
  return names;
}

Header read_header(Lines& lines, Dialect& dialect, const std::vector<std::string>& order,
                   const std::string& run, bool one_run) {
  Header header;
  std::vector<std::string> preamble;
  bool found = false;
  while (!found && lines.next()) {
    const std::string_view line = lines.text();
    if (line.find('\0') != npos)
      fail<InputError>("{}:{}: a NUL byte; UTF-16 must be made UTF-8 first (iconv -f UTF-16)",
                       lines.name(), lines.number());
    if (line.find('\r') != npos)
      fail<InputError>(
          "{}:{}: a carriage return within the line; make the line ends LF first (tr '\\r' '\\n')",
          lines.name(), lines.number());
    const char mark = first_mark(line);
    if (mark == no_mark) continue;
    if (mark == comment_mark) header.comments.emplace_back(trim(line));
    else if (dialect.choose(line) || is_missing_record(line, dialect, header.comments, preamble))
      found = true;
    else preamble.emplace_back(line);
    if (preamble.size() > longest_preamble)
      fail<InputError>("{}: no numbers in the first {} lines", lines.name(), longest_preamble);
  }
  if (!found) fail<InputError>("{}: no records", lines.name());

  std::size_t width = dialect.split(lines.text()).size();
  std::vector<std::string> names;
  if (!preamble.empty()) {
    header.names_line = preamble.back();
    preamble.pop_back();
    names = names_in(header.names_line, dialect);
    if (names.back().empty() && names.size() > 1)
      names.pop_back();  // a delimiter that ends the line
    if (width == names.size() + 1 && dialect.split(lines.text()).back().text.empty()) --width;
  } else {
    const std::size_t last = last_remark(header.comments);
    if (last != npos) names = commented_names(header.comments[last], dialect, width);
    if (!names.empty())
      header.comments.erase(header.comments.begin() + static_cast<std::ptrdiff_t>(last));
  }
  for (std::string& line : preamble) header.comments.push_back("# " + std::move(line));
  header.named = !names.empty();

  std::vector<Column> columns;
  for (std::size_t i = 0; i < std::max(width, names.size()); ++i) {
    if (i < names.size()) columns.push_back(read_column(names[i]));
    else columns.push_back({i < order.size() ? order[i] : ""});
    if (columns.back().name.empty()) columns.back().name = fmt::format("c{}", i + 1);
  }
  try {
    header.layout = one_run ? Layout::one(columns) : Layout::of(columns, run);
  } catch (const Error& error) {
    fail<InputError>("{}: {}", lines.name(), error.what());
  }
  if (header.named && (header.layout.side_by_side ? width > names.size() : width != names.size()))
    fail<InputError>("{}:{}: {} field{} under a line of {} names{}", lines.name(), lines.number(),
                     width, width == 1 ? "" : "s", names.size(),
                     dialect.separator() == ','
                         ? "; if some of its commas are decimal ones, make them points first"
                         : "");
  return header;
}

}  // namespace rolling
