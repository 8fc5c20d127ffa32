#include "signal/selection.h"

#include <algorithm>
#include <utility>

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) hampel_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Judged> samples) {
  outliers_ += static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const Judged& s) { return !s.kept; }));
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
  if (hampel_ && t > options_.to) take(hampel_->finish());
  if (hampel_ && within) take(hampel_->push(t, y));
  else wait({t, y, within});
  return decided_;
}

void Selection::finish() {
  decided_.clear();
  if (hampel_) take(hampel_->finish());
  if (!options_.coast) return;
  roll_ = free_roll({run_.data(), run_.size()}, options_.positions);
  if (roll_.other) doubt_ = {run_[roll_.begin].t, run_[*roll_.other].t};
}

std::span<const Judged> Selection::rest() {
  if (!options_.coast && std::exchange(any_rest_, false)) return decided_;
  constexpr std::size_t at_a_time = 1024;
  decided_.clear();
  for (; out_ < in_run_.size() && decided_.size() < at_a_time; ++out_) {
    const std::size_t i = out_of_run_;
    if (in_run_[out_]) ++out_of_run_;
    const bool kept = in_run_[out_] && i >= roll_.begin && i < roll_.end;
    decided_.push_back(kept ? Judged{run_[i].t, run_[i].y, true} : Judged{0, 0, false});
  }
  return decided_;
}

}  // namespace rolling
