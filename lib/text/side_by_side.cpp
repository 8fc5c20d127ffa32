#include "text/side_by_side.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "text/delimiters.h"

namespace rolling {

Side::Line Side::operator[](std::size_t i) const {
  const Entry& line = lines_[i];
  return {{text_.data() + line.begin, line.end - line.begin}, line.number, line.kind};
}

/// Ends a line: it is the text that has been appended since the last call.
void Side::take(LineKind kind, std::size_t number) {
  lines_.push_back({number, lines_.empty() ? 0 : lines_.back().end, text_.size(), kind});
}

std::vector<Side> take_apart(Lines& lines, Dialect& dialect, const Layout& layout) {
  std::vector<Side> sides(layout.runs.size());
  while (lines.next()) {
    const LineKind kind = lines.kind();
    if (kind == LineKind::blank) break;
    if (kind == LineKind::history) {
      refuse_error_line(lines);
      lines.put_back();
      break;
    }
    if (kind == LineKind::comment) {
      sides.front().text_.append(lines.text());
      sides.front().take(kind, lines.number());
      continue;
    }
    std::span<const Field> fields;
    try {
      fields = dialect.split(lines.text());
      if (fields.size() > layout.width)
        fail("{} fields where the first row has {}", fields.size(), layout.width);
    } catch (const Error& error) {
      fail<InputError>("{}:{}: {}", lines.name(), lines.number(), error.what());
    }
    for (std::size_t r = 0; r < sides.size(); ++r) {
      Side& side = sides[r];
      bool reading = false, first = true;
      for (const std::size_t i : layout.runs[r].fields) {
        if (!std::exchange(first, false)) side.text_.append('\t');
        if (i >= fields.size()) continue;
        append_field(side.text_, fields[i].text);
        reading |= !layout.shared[i] && !fields[i].text.empty();
      }
      side.take(kind, lines.number());
      if (reading) side.with_readings_ = side.lines_.size();
    }
  }
  for (Side& side : sides)
    side.lines_.erase(
        std::remove_if(side.lines_.begin() + static_cast<std::ptrdiff_t>(side.with_readings_),
                       side.lines_.end(),
                       [](const Side::Entry& line) { return line.kind == LineKind::record; }),
        side.lines_.end());
  return sides;
}

}  // namespace rolling
