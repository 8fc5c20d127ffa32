// SPDX-License-Identifier: GPL-3.0-or-later
#include "signal/selection.h"

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) test_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Sample> tested) {
  for (const Sample& s : tested) {
    if (std::isnan(s.y)) outliers_.push_back(s.t);
    run_.append(s);
  }
}

std::span<const Sample> Selection::push(double t, double y) {
  if (!options_.coast) run_.truncate(0);
  const bool within = t >= options_.from && t <= options_.to;
  if (test_ && t > options_.to) take(test_->finish());
  if (test_ && within) take(test_->push(t, y));
  else run_.append(Sample{t, within ? y : NAN});
  return options_.coast ? std::span<const Sample>() : known();
}

std::span<const Sample> Selection::finish() {
  if (!options_.coast) run_.truncate(0);
  if (test_) take(test_->finish());
  if (!options_.coast) return known();
  std::vector<Sample> run;
  for (const Sample& s : known())
    if (!std::isnan(s.y)) run.push_back(s);
  if (run.empty()) return known();
  roll_ = free_roll(run, options_.positions);
  for (std::size_t i = 0; i < run_.size(); ++i)
    if (double& y = run_.data()[i].y; run_[i].t < roll_->kept.from || run_[i].t > roll_->kept.to)
      y = NAN;
  return known();
}

}  // namespace rolling
