// Selection of the samples of a run: those between two times, without outliers, of the free roll.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "base/growing.h"
#include "signal/free_roll.h"
#include "signal/hampel.h"

namespace rolling {

struct SelectionOptions {
  double from = -std::numeric_limits<double>::infinity(),
         to = std::numeric_limits<double>::infinity();  ///< [s]
  /// Readings further from the median than this many scaled MADs are left out; 0: none.
  double outliers = 0;
  Width width{};           ///< width of the windows for outliers
  bool coast = false;      ///< selects the free roll only, which needs the whole run
  bool positions = false;  ///< the column is a position, not a speed (for coast)

  bool all() const {
    return !coast && outliers == 0 && std::isinf(from) && std::isinf(to);
  }  ///< true if no sample is left out
};

class Selection {
 public:
  explicit Selection(const SelectionOptions&);

  /// The samples for which the decision is now known, in order. Valid until the next call.
  std::span<const Judged> push(double t, double y);
  /// Ends the run. Throws Error as free_roll does.
  void finish();
  /// After finish(): the remaining samples in order, in blocks; empty when there are no more. t and
  /// y of samples that are left out are not set. Valid until the next call.
  std::span<const Judged> rest();
  std::size_t outliers() const { return outliers_; }  ///< number of outliers so far
  /// After finish(): the two possible beginnings of the free roll, if it is doubtful.
  struct Doubt {
    double begin, other;  ///< the chosen time [s], and the one by less significant corners
  };
  const std::optional<Doubt>& doubt() const { return doubt_; }

 private:
  void take(std::span<const Judged>);
  void wait(const Judged&);

  SelectionOptions options_;
  std::optional<Hampel> hampel_;
  std::vector<Judged> decided_;
  bool any_rest_ = true;
  std::size_t outliers_ = 0;
  // For coast: run_ holds the samples of the run that are between the two times and not outliers;
  // in_run_ says for each sample whether it is one of them.
  Growing<Sample> run_;
  std::vector<bool> in_run_;
  Stretch roll_{0, 0};
  std::size_t out_ = 0, out_of_run_ = 0;  // by rest()
  std::optional<Doubt> doubt_;
};

}  // namespace rolling
