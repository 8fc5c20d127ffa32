// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/selection.h"

#include <algorithm>

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) test_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Judged> samples) {
  for (const Judged& s : samples)
    if (!s.kept) outliers_.push_back(s.t);
  decided_.insert(decided_.end(), samples.begin(), samples.end());
}

std::span<const Judged> Selection::push(double t, double y) {
  if (!options_.coast) decided_.clear();
  const bool within = t >= options_.from && t <= options_.to;
  if (test_ && t > options_.to) take(test_->finish());
  if (test_ && within) take(test_->push(t, y));
  else decided_.push_back({t, y, within});
  return options_.coast ? std::span<const Judged>() : decided_;
}

std::span<const Judged> Selection::finish() {
  if (!options_.coast) decided_.clear();
  if (test_) take(test_->finish());
  if (options_.coast) keep_roll();
  return decided_;
}

void Selection::keep_roll() {
  std::vector<Sample> run;
  run.reserve(decided_.size());
  for (const Judged& s : decided_)
    if (s.kept) run.push_back({s.t, s.y});
  if (run.empty()) return;
  const auto [kept, how, after, other] = free_roll(run, options_.positions);
  std::size_t i = 0;
  for (Judged& s : decided_)
    if (s.kept) s.kept = i >= kept.begin && i < kept.end, ++i;
  const auto first = [&](std::size_t at) { return run[std::min(at, run.size() - 1)].t; };
  const auto last = [&](std::size_t end) { return run[end - 1].t; };
  roll_ = Roll{kept.end - kept.begin, decided_.size(), how, first(kept.begin),
               last(kept.end),        first(after),    {}};
  if (other) roll_->other = {first(other->begin), last(other->end)};
}

}  // namespace rolling
