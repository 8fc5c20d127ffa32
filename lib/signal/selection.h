// Which samples of a run are worth looking at: those between two times, without outliers, of the
// free roll.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "signal/free_roll.h"
#include "signal/hampel.h"

namespace rolling {

struct SelectionOptions {
  double from = -std::numeric_limits<double>::infinity(),
         to = std::numeric_limits<double>::infinity();  ///< [s]
  double outliers = 0;  ///< leaves out what is further off than this many scaled MADs; 0: nothing
  Width width{};        ///< of the window for that
  bool coast = false;   ///< the free roll only: needs the whole run
  bool positions = false;  ///< for that: the column is a position, not a speed

  bool all() const {
    return !coast && outliers == 0 && std::isinf(from) && std::isinf(to);
  }  ///< nothing is left out
};

class Selection {
 public:
  explicit Selection(const SelectionOptions&);

  /// The samples that are now decided on, in order. Valid until the next call.
  std::span<const Judged> push(double t, double y);
  /// The run has ended. Throws Error as free_roll does.
  void finish();
  /// After finish(): the samples that were still to be decided on, in order, some at a time; none
  /// when all are out. t and y of those that are left out are not told. Valid until the next call.
  std::span<const Judged> rest();
  std::size_t outliers() const { return outliers_; }  ///< so far
  /// After finish(): where the free roll is in doubt.
  struct Doubt {
    double begin, other;  ///< it begins at this time [s]; or, by fainter signs, at the other
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
  // With coast, of the whole run: the samples that are neither outliers nor at other times, and
  // which of all samples they are.
  std::vector<Sample> run_;
  std::vector<bool> in_run_;
  Stretch roll_{0, 0};
  std::size_t out_ = 0, out_of_run_ = 0;  // by rest()
  std::optional<Doubt> doubt_;
};

}  // namespace rolling
