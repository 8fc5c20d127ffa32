// Laws D(v) of a mat with a few coefficients: one entry in a table for each.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rolling {

/// A law D(v) for v > 0, with the properties that a fit needs.
struct Law {
  /// A coefficient. Its unit is that of D to the power `D`, times that of v to the power `v`; or,
  /// as that of a in a v^b, to the power of minus the coefficient number `exponent`.
  struct Coefficient {
    const char* name;
    int D = 1, v = 0;
    int exponent = -1;  ///< none
  };
  const char* formula;  ///< as a person writes it: "d0 + d1 v"
  std::vector<Coefficient> coefficients;
  /// D at v, and its derivatives by the coefficients.
  double (*shift)(const double* c, double v, double* by_c);
  /// The coefficients that the formula names, in the same units, of those that `shift` takes, and
  /// their derivatives row by row; none where they are the same.
  void (*written)(const double* c, double* as_written, double* by_c);
  /// Starting points of a search, for a D of order one at speeds up to 1.
  std::vector<std::vector<double>> starts;
  bool is_power = false;  ///< a v^b itself, or a special case of it

  static constexpr std::size_t most = 3;  ///< coefficients
};

/// a v^b first, then the laws that are compared with it:
///   d0, d0 + d1 v, d0 + d1 v + d2 v^2, d0 + d2 v^2: rolling resistance and drag, as coast-down
///     tests fit them (SAE J1263; 40 CFR 1066.310);
///   d0 + a v^n: dry friction beside a power law;
///   d0 + 2 p v w/(v^2 + w^2): a mat of one relaxation time, whose loss has a maximum p at the
///     speed w. Resistance rises with the speed of deformation and falls where the mat has no time
///     to give way: Flom and Bueche (1959), J. Appl. Phys. 30, 1725; May, Morris and Atack (1959),
///     J. Appl. Phys. 30, 1713, whose curve follows the distribution of relaxation times, for one
///     of them this peak; Poeschel, Schwager and Brilliantov (1999), Eur. Phys. J. B 10, 169.
const std::vector<Law>& laws();

/// A law in units in which speeds and shifts are of order one: D = D_unit law(c; v / v_unit).
struct LawInUnits {
  const Law* law;
  double D_unit, v_unit;

  std::size_t size() const { return law->coefficients.size(); }
  /// D [m] at v > 0 [m/s], and its derivatives by c.
  double operator()(const double* c, double v, double* by_c) const {
    const double D = law->shift(c, v / v_unit, by_c);
    for (std::size_t j = 0; j < size(); ++j) by_c[j] *= D_unit;
    return D_unit * D;
  }
  /// Coefficient j of the formula in SI units, and its derivatives by c.
  double in_SI(const double* c, std::size_t j, std::span<double> by_c) const;
};

}  // namespace rolling
