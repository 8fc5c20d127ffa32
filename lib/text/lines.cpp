#include "text/lines.h"

#include "base/error.h"

namespace rolling {
namespace {

constexpr std::size_t longest = 1 << 20;  // as Input has it

/// The text ends within a quoted field, if it begins in one or not. Which character separates
/// fields may not be known yet.
bool ends_in_quotes(std::string_view text, bool quoted) {
  bool opens = true;
  for (auto c = text.begin(); c != text.end(); ++c)
    if (!quoted) {
      quoted = *c == '"' && opens;
      opens = *c == ',' || *c == ';' || *c == '\t';
    } else if (*c == '"') {
      if (c + 1 != text.end() && c[1] == '"') ++c;  // stands for one
      else quoted = opens = false;
    }
  return quoted;
}

}  // namespace

void Lines::join_quoted() {
  if (first_mark(text_) == comment_mark || !ends_in_quotes(text_, false)) return;
  joined_ = text_;
  do {
    if (joined_.size() > longest || !input_.next(text_))
      fail<InputError>("{}:{}: a quote that does not end", name(), number_);
    (joined_ += '\n') += text_;
  } while (ends_in_quotes(text_, true));
  text_ = joined_;
}

void Lines::keep() {
  std::vector<Kept> all;
  do all.push_back({number_, std::string(text_)});
  while (next());
  kept_ = std::move(all);
  next();
}

bool Lines::next_kept() {
  if (kept_at_ == kept_.size()) return false;
  number_ = kept_[kept_at_].number;
  text_ = kept_[kept_at_++].text;
  return true;
}

}  // namespace rolling
