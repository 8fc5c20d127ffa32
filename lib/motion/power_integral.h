// Integrals of powers of a speed in the variable y = ln(v0/u), from which the free roll is
// composed.
#pragma once

namespace rolling {

/// int_0^lambda e^(-s y) dy = (1 - e^(-s lambda)) / s; with lambda = ln(v0/v),
///   P(s) = int_v^v0 u^(s-1) du = v0^s power_integral(s, lambda).
/// Any real s, stable through s = 0; lambda >= 0. lambda = infinity is v = 0: 1/s, and infinite for
/// s <= 0.
double power_integral(double s, double lambda);

/// int_0^lambda y e^(-s y) dy, which is -d/ds of power_integral:
///   dP/ds = int_v^v0 ln(u) u^(s-1) du = v0^s (ln(v0) power_integral - power_moment).
/// `integral` is power_integral(s, lambda).
double power_moment(double s, double lambda, double integral);
/// The same within 4 ulp, for a caller who also knows decay = e^(-s lambda).
double power_moment(double s, double lambda, double integral, double decay);

/// int_0^lambda (e^(-y) - e^(-lambda)) e^(-s y) dy, and the same with a factor y under the
/// integral. As differences of the above they would lose all their digits for small lambda.
/// `integral` and `moment` are the above for s, `next` is power_integral(s + 1, lambda).
struct HeadwayIntegrals {
  double integral, moment;
};
HeadwayIntegrals headway_integrals(double s, double lambda, double integral, double moment,
                                   double next);

}  // namespace rolling
