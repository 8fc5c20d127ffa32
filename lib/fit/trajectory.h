// The trajectory routes from within: the roll that fits best when it is known how its column was
// made.
#pragma once

#include "fit/routes.h"
#include "motion/trajectory.h"

#include <cmath>
#include <optional>
#include <utility>

namespace rolling {

/// The law in the fit's own parameters, all of order one: of every run v0 in units of v_ref and x0
/// in units of x_ref; then, shared, ln of the height D(v_ref) (ln a itself is nearly collinear with
/// b), and b. What is held fixed has no place in theta.
struct Parameters {
  const FitOptions& options;
  bool position;
  std::size_t runs;
  double v_ref = 1, log_v_ref = 0, x_ref = 1;

  bool free_x0() const { return position && !options.x0; }
  std::size_t of_law() const { return !options.a + !options.b; }
  std::size_t per_run() const { return !options.v0 + free_x0(); }
  std::size_t columns() const { return per_run() + of_law(); }
  std::size_t count() const { return runs * per_run() + of_law(); }
  std::size_t v0_at(std::size_t r) const { return r * per_run(); }
  std::size_t x0_at(std::size_t r) const { return v0_at(r) + !options.v0; }
  std::size_t a_at() const { return runs * per_run(); }

  double b(const std::vector<double>& theta) const { return options.b ? *options.b : theta.back(); }
  double a(const std::vector<double>& theta) const {
    return options.a ? *options.a : std::exp(theta[a_at()] - b(theta) * log_v_ref);
  }
  double v0(const std::vector<double>& theta, std::size_t r) const {
    return options.v0 ? std::abs(*options.v0) : theta[v0_at(r)] * v_ref;
  }
  double x0(const std::vector<double>& theta, std::size_t r) const {
    return !position ? 0 : options.x0 ? *options.x0 : theta[x0_at(r)] * x_ref;
  }
  Trajectory trajectory(const FittedRun& roll, const std::vector<double>& theta,
                        std::size_t r) const {
    return {roll.body, options.geometry, {a(theta), b(theta)}, v0(theta, r)};
  }

  /// The derivatives by the parameters of a run and the shared ones, `stride` apart, of what has
  /// these by a, b, and by its v0 and x0.
  void chain(double* to, std::size_t stride, double a, double by_a, double by_b, double by_v0 = 0,
             double by_x0 = 0) const noexcept {
    const auto put = [&](double value) { *std::exchange(to, to + stride) = value; };
    if (!options.v0) put(by_v0 * v_ref);
    if (free_x0()) put(by_x0 * x_ref);
    if (!options.a) put(a * by_a);
    if (!options.b) put(by_b - (options.a ? 0 : log_v_ref * a * by_a));
  }
};

/// Refers to what it is made of.
System system_of(const std::vector<FittedRun>&, const Parameters&, const KnownNoise&);

/// Where the search begins, from the data alone. Sets v_ref and x_ref of the parameters, and the
/// coarse v0 and x0 of the runs.
std::vector<double> first_guess(std::vector<FittedRun>&, Parameters&);

// The model goes through the same filters as the data, so the residuals are noise in every
// direction; the floor only covers rounding.
inline constexpr double rounding_share = 1e-6;

/// What made the fitted column of each run, and how much of its noise is white; no responses if
/// that is not known.
struct Making {
  std::vector<NoiseResponse> responses;
  double white_share = rounding_share;
};

/// The runs as they are fitted, and the noise that ties their records together.
struct Rolls {
  std::vector<FittedRun> of;
  KnownNoise noise;
};
Rolls make_rolls(const std::vector<FitRun>&, const std::vector<Rows>&, bool position, const Making&,
                 const FitOptions&);

/// The minimum from theta, or from the first guess if there is none. The position route takes slow
/// records from the rows.
RouteFit fit_rolls(const std::vector<FitRun>&, std::vector<Rows>&, Parameters&, const Making&,
                   std::vector<double> theta = {});

/// The fit through the positions of which the speeds are most likely differences; none if they are
/// not, or if it leaves residuals that do not look white.
std::optional<RouteFit> fit_differences(const std::vector<FitRun>&, const std::vector<Rows>&,
                                        Parameters&, const std::vector<double>& theta);

}  // namespace rolling
