// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/selection.h"

#include <algorithm>

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) test_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Judged> tested) {
  for (const Judged& s : tested) {
    if (!s.kept) outliers_.push_back(s.t), off_.push_back(run_.size());
    run_.append(Sample{s.t, s.y});
  }
}

std::span<const Judged> Selection::push(double t, double y) {
  const bool within = t >= options_.from && t <= options_.to;
  if (test_ && t > options_.to) take(test_->finish());
  if (test_ && within) {
    take(test_->push(t, y));
  } else {
    if (!within) off_.push_back(run_.size());
    run_.append(Sample{t, y});
  }
  return options_.coast ? std::span<const Judged>() : next();
}

void Selection::finish() {
  if (test_) take(test_->finish());
  if (options_.coast) keep_roll();
}

std::span<const Judged> Selection::next() {
  constexpr std::size_t at_once = 1000;
  decided_.clear();
  for (; next_ < run_.size() && decided_.size() < at_once; ++next_) {
    const bool is_off = next_off_ < off_.size() && off_[next_off_] == next_;
    const std::size_t number = next_ - next_off_;  // among the others
    next_off_ += is_off;
    decided_.push_back(
        {run_[next_].t, run_[next_].y, !is_off && number >= kept_.begin && number < kept_.end});
  }
  if (next_ == run_.size()) run_.truncate(0), off_.clear(), next_ = next_off_ = 0;
  return decided_;
}

void Selection::keep_roll() {
  std::vector<Sample> others;
  std::span<const Sample> run(run_.data(), run_.size());
  for (std::size_t i = 0, k = 0; i < run.size() && !off_.empty(); ++i)
    if (k < off_.size() && off_[k] == i) ++k;
    else others.push_back(run[i]);
  if (!off_.empty()) run = others;
  if (run.empty()) return;
  const auto [kept, how, after, other] = free_roll(run, options_.positions);
  kept_ = kept;
  const auto first = [&](std::size_t at) { return run[std::min(at, run.size() - 1)].t; };
  const auto last = [&](std::size_t end) { return run[end - 1].t; };
  roll_ = Roll{kept.end - kept.begin, run_.size(),  how, first(kept.begin),
               last(kept.end),        first(after), {}};
  if (other) roll_->other = {first(other->begin), last(other->end)};
}

}  // namespace rolling
