#include "text/lines.h"

#include <algorithm>

#include "base/error.h"

namespace rolling {

void Lines::join_quoted() {
  const auto last = text_.rfind('"');
  if (last == text_.npos) return;
  const bool opens = last == 0 || text_[last - 1] == ',' || text_[last - 1] == ';' || text_[last - 1] == '\t';
  if (!opens || std::count(text_.begin(), text_.end(), '"') % 2 == 0) return;
  joined_ = text_;
  do {
    if (!input_.next(text_)) fail<InputError>("{}:{}: a quote that does not end", name(), number_);
    (joined_ += '\n') += text_;
  } while (std::count(joined_.begin(), joined_.end(), '"') % 2 == 1);
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
