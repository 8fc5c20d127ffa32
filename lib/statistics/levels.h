// SPDX-License-Identifier: GPL-3.0-or-later
// The levels that decide on warnings, refusals and the kind of standard errors of a row. Each
// with its rate of false alarms, where that was measured: in 1000 good runs of rubber and of
// felt (make coverage, rolling-fits(7)), unless another place is named.
#pragma once

#include <cstddef>

namespace rolling::levels {

/// Ljung-Box: at or below it the noise is taken as not white: 0.5 %.
inline constexpr double not_white = 0.005;
/// With 60 rows the test often misses an autocorrelation of 0.5. At or below this limit a
/// positive one gets errors that allow for it: one run in ten, at 1 to 2 % in their size.
inline constexpr double nearly_white = 0.17;
/// Fewer rows do not show an autocorrelation. The 95 % intervals of a held in .66 of 200 runs of 20
/// speeds that were means of three when only runs of 30 rows were tested, and hold in .95 now; of
/// white speeds in .93 both times.
inline constexpr std::size_t least_tested = 20;
/// White noise turns back so few steps with at most this probability, by a bound of it: 1 % of
/// white speeds on rubber, 0.4 % on felt.
inline constexpr double few_reversals = 0.1;
/// Unequal variance, along the runs or between them: 1 %.
inline constexpr double uneven = 0.01;
/// Runs of a joint fit disagree: 1 % (tests/unit/fit/refits_agreement_test.cpp).
inline constexpr double runs_disagree = 0.01;
/// Of runs that agree by that, one lies off, after Bonferroni's correction; in a check alone. 1 %:
/// 17 of 2000 sets of 50 rows (tests/unit/fit/refits_agreement_rows_test.cpp).
inline constexpr double run_off = 0.01;
/// The beginning is disturbed, after Bonferroni's correction: 0.1 %. The others must be white.
inline constexpr double beginning = 0.001, beginning_white = 0.009;
/// The clock of a run jumps, after Bonferroni's correction: 0.1 %.
inline constexpr double clock_jump = 0.001;
/// A signal of one turn, for all runs: 0.5 to 0.8 %, since another period must not explain it.
inline constexpr double one_turn = 0.01;
/// The thirds of a roll differ in their signal of one turn: 5 % of bodies out of balance do.
inline constexpr double thirds = 0.05;
/// Thirds that differ by less than this share of the squares of what they have in common are alike.
inline constexpr double of_common = 0.1;
/// In the search for one turn, a residual of more standard deviations than this counts as one of
/// this many.
inline constexpr double cut_off = 3;
/// ln of the likelihood ratio for rounding: 1 %.
inline constexpr double likely = 3;
/// The same for the best of the eight filters of sensors. At 3 the 95 % intervals of a and b held
/// in .915 and .920 of 400 runs of white speeds, at 5 and without a search in .920 and .927.
inline constexpr double likely_filter = 5;
/// A reading is off if it lies at least 10 standard deviations from the motion, with 12 degrees of
/// freedom or more: by Student's t noise alone does that in less than one run of 100,000.
inline constexpr double off = 10;
/// Readings on a grid are not rounded to it if rounding alone would leave residuals as small with
/// at most this probability.
inline constexpr double not_rounded = 0.001;
/// Readings on a grid repeat where they move by less than it, and rms is near 0.29 of it.
inline constexpr double grid_of_rms = 0.5, repeats_of_grid = 1. / 3;
/// Rounding alone makes an rms of 0.29 of the grid, gates that stand on a grid far less. Positions
/// to 0.2 mm without other noise: the 95 % intervals of b held in .88 of 1000 runs on rubber, and
/// in all on felt (make coverage). Noise of 0.2 of the grid makes an rms of 0.35.
inline constexpr double gates_of_grid = 0.2, rounding_of_grid = 0.32;
/// AICc by which another law leaves a v^b no support (Burnham and Anderson 2002, section 2.6), and
/// by which a v^b is said to be as good as any other.
inline constexpr double another_law = 10, no_better_law = 2;
/// The sum of squares at either end of an interval has risen as it should within this factor.
inline constexpr double rise = 1.35;
/// A model is bent if a step of 1.96 standard errors differs by more than this share of itself from
/// a linear one.
inline constexpr double bent = 0.1;
/// A larger error of b is no knowledge of a mat: D at half of a speed is not known to a factor of
/// 50.
inline constexpr double largest_sigma_b = 3;
/// In the exact geometry a search tries no exponent beyond it.
inline constexpr double largest_b = 60;
/// sigma_a/a above which a +- sigma_a is no interval: ln a has the normal distribution. There a +-
/// 1.96 sigma_a holds the truth in 93.6 %, but misses it by 3 sigma_a six times too often.
inline constexpr double uncertain_a = 0.3;
/// b lies below -1/2 by so many standard errors: no mat is known whose shift grows so at rest.
inline constexpr double least_b = -0.5, below_least_b = 3;
/// D/R of rolling bodies, from steel on steel to a wheel in sand.
inline constexpr double least_D_over_R = 1e-4;
/// Above so many times sqrt(g R) a body that rolls as a whole hardly begins: a bowling ball has 9,
/// a marble at 3 m/s 14. Vehicles, with a K below this one, have another limit [m/s]: a fast train
/// has 83.
inline constexpr double fast = 15, fast_vehicle = 85, K_of_vehicles = 0.3;
/// The columns x and v of a run contradict each other by more than this factor of the way.
inline constexpr double ways_differ = 1.25;
/// A heavier body, with a mass of so many R^3 [kg/m^3], is hardly made.
inline constexpr double heavy = 1e6;
/// A video has y beside x. Above this ratio of their changes x is more than 0.5 % short of the way.
inline constexpr double oblique = 0.1;
/// v0 above so many times the mean speed between any two readings is not measured.
inline constexpr double v0_over_speeds = 10;

}  // namespace rolling::levels
