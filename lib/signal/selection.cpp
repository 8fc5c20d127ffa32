// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/selection.h"

#include <algorithm>
#include <utility>

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) test_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Judged> samples) {
  for (const Judged& s : samples)
    if (!s.kept) outliers_.push_back(s.t);
  for (const Judged& s : samples) wait(s);
}

void Selection::wait(const Judged& s) {
  if (!options_.coast) return decided_.push_back(s);
  in_run_.push_back(s.kept);
  if (s.kept) run_.append({s.t, s.y});
}

std::span<const Judged> Selection::push(double t, double y) {
  decided_.clear();
  const bool within = t >= options_.from && t <= options_.to;
  if (test_ && t > options_.to) take(test_->finish());
  if (test_ && within) take(test_->push(t, y));
  else wait({t, y, within});
  return decided_;
}

void Selection::finish() {
  decided_.clear();
  if (test_) take(test_->finish());
  if (!options_.coast || run_.empty()) return;
  const FreeRoll found = free_roll({run_.data(), run_.size()}, options_.positions);
  kept_ = found.kept;
  const auto first = [&](std::size_t i) { return run_[std::min(i, run_.size() - 1)].t; };
  const auto last = [&](std::size_t end) { return run_[end - 1].t; };
  roll_ = Roll{kept_.end - kept_.begin, in_run_.size(),     found.how, first(kept_.begin),
               last(kept_.end),         first(found.after), {}};
  if (found.other) roll_->other = {first(found.other->begin), last(found.other->end)};
}

std::span<const Judged> Selection::rest() {
  if (!options_.coast && std::exchange(any_rest_, false)) return decided_;
  constexpr std::size_t at_a_time = 1024;
  decided_.clear();
  for (; out_ < in_run_.size() && decided_.size() < at_a_time; ++out_) {
    const std::size_t i = out_of_run_;
    if (in_run_[out_]) ++out_of_run_;
    const bool kept = in_run_[out_] && i >= kept_.begin && i < kept_.end;
    decided_.push_back(kept ? Judged{run_[i].t, run_[i].y, true} : Judged{0, 0, false});
  }
  return decided_;
}

}  // namespace rolling
