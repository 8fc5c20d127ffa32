// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/selection.h"

namespace rolling {

Selection::Selection(const SelectionOptions& options) : options_(options) {
  if (options_.outliers > 0) test_.emplace(options_.width, options_.outliers);
}

void Selection::take(std::span<const Sample> tested) {
  for (const Sample& s : tested) {
    if (std::isnan(s.y)) outliers_.push_back(s.t);
    run_.push_back(s);
  }
}

std::span<const Sample> Selection::push(double t, double y) {
  if (!options_.needs_run()) run_.clear();
  const bool within = t >= options_.from && t <= options_.to;
  if (test_ && t > options_.to) take(test_->finish());
  if (test_ && within) take(test_->push(t, y));
  else run_.push_back({t, within ? y : NAN});
  return options_.needs_run() ? std::span<const Sample>() : run_;
}

std::span<const Sample> Selection::finish() {
  if (!options_.needs_run()) run_.clear();
  if (test_) take(test_->finish());
  if (!options_.needs_run()) return run_;
  std::vector<Sample> run;
  for (const Sample& s : run_)
    if (!std::isnan(s.y)) run.push_back(s);
  if (run.empty()) return run_;
  if (options_.rolls) rolls_ = free_rolls(run, options_.positions);
  else rolls_ = {free_roll(run, options_.positions)};
  auto roll = rolls_.begin();
  for (auto& [t, y] : run_) {
    while (roll != rolls_.end() && t > roll->kept.to) ++roll;
    if (roll == rolls_.end() || t < roll->kept.from) y = NAN;
  }
  return run_;
}

}  // namespace rolling
