#include "signal/selection.h"

#include <algorithm>

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) hampel_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Judged> samples) {
  outliers_ += static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const Judged& s) { return !s.kept; }));
  decided_.insert(decided_.end(), samples.begin(), samples.end());
}

std::span<const Judged> Selection::push(double t, double y) {
  if (!options_.coast) decided_.clear();
  const bool within = t >= options_.from && t <= options_.to;
  if (hampel_ && t > options_.to) take(hampel_->finish());
  if (hampel_ && within) {
    take(hampel_->push(t, y));
  } else {
    Judged& judged = decided_.emplace_back();
    judged.t = t, judged.y = y, judged.kept = within;
  }
  return options_.coast ? std::span<const Judged>() : decided_;
}

std::span<const Judged> Selection::finish() {
  if (!options_.coast) decided_.clear();
  if (hampel_) take(hampel_->finish());
  if (!options_.coast) return decided_;
  std::vector<Sample> run;
  run.reserve(decided_.size());
  for (const Judged& s : decided_)
    if (s.kept) run.push_back({s.t, s.y});
  const Stretch roll = free_roll(run, options_.positions);
  if (roll.other) doubt_ = {run[roll.begin].t, run[*roll.other].t};
  std::size_t i = 0;
  for (Judged& s : decided_)
    if (s.kept) s.kept = i >= roll.begin && i < roll.end, ++i;
  return decided_;
}

}  // namespace rolling
