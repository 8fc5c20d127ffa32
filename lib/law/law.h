// SPDX-License-Identifier: GPL-3.0-or-later
// The law D(v) of a mat: a value, whatever its form. The forms with coefficients are the rows of
// one table.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rolling {

/// D at a speed, and its derivative by ln v [m].
struct Shift {
  double D, by_log_v;
};

/// Interpolates by cubics with the slopes of Steffen (1990, Astron. Astrophys. 239, 443), and at
/// the first and the last point with that of the line to the next one: monotone between two points,
/// with a continuous derivative. Below the lowest point D is constant; above the highest point the
/// law is not defined.
class TableLaw {
 public:
  /// Points in any order, with v [m/s] >= 0, D [m] > 0 and all v different; else it throws Error.
  TableLaw(std::vector<double> v, std::vector<double> D);

  /// At v [m/s] >= 0. Above the highest speed D continues with a constant slope, only for the trial
  /// steps of a solver.
  Shift at(double v) const;
  const std::vector<double>& speeds() const { return v_; }  ///< increasing [m/s]

 private:
  std::vector<double> v_, D_;
  std::vector<double> c1_, c2_, c3_;  // D = D_[i] + s (c1 + s (c2 + s c3))
};

/// D = a v^b, the law of the paper. It is odd in v, since the mat is the same in both directions.
struct PowerLaw {
  double a;  ///< shift at 1 m/s [m]
  double b;  ///< exponent

  /// Shift D [m] at the velocity v [m/s]: it has the sign of v and is 0 at rest.
  double operator()(double v) const {
    return v == 0 ? 0 : std::copysign(a * std::pow(std::abs(v), b), v);
  }
};

/// A form of a law D(v; c) for v > 0, with the properties that a fit needs.
struct LawForm {
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
  using ShiftOf = Shift(const double* c, double v, double* by_c);
  ShiftOf* shift;
  /// The same by other coefficients, which suit a search, and those of the formula of these, in the
  /// same units, with their derivatives row by row; none where those of the formula suit it.
  ShiftOf* searched = nullptr;
  void (*written)(const double* c, double* as_written, double* by_c) = nullptr;
  /// Starting points of a search, for a D of order one at speeds up to 1; none of a v^b, which the
  /// routes start by themselves.
  std::vector<std::vector<double>> starts = {};
  bool is_power = false;  ///< a v^b itself, or a special case of it
  int drag = -1;          ///< the number of the coefficient d2 of v^2, the drag of the air, if any

  static constexpr std::size_t most = 3;  ///< coefficients
};

/// a v^b first, then the laws that are compared with it:
///   d0, d0 + d1 v, d0 + d1 v + d2 v^2, d0 + d2 v^2: rolling resistance and drag, as coast-down
///     tests fit them (SAE J1263; 40 CFR 1066.310);
///   d0 + a v^b: dry friction beside a power law;
///   d0 + 2 p v w/(v^2 + w^2): a mat of one relaxation time, whose loss has a maximum p at the
///     speed w. Resistance rises with the speed of deformation and falls where the mat has no time
///     to give way: Flom and Bueche (1959), J. Appl. Phys. 30, 1725; May, Morris and Atack (1959),
///     J. Appl. Phys. 30, 1713, whose curve follows the distribution of relaxation times, for one
///     of them this peak; Poeschel, Schwager and Brilliantov (1999), Eur. Phys. J. B 10, 169.
const std::vector<LawForm>& laws();

/// A law: a form with its coefficients, or points. Units in which speeds and shifts are of order
/// one suit a search: D = D_unit form(c; v / v_unit).
class Law {
 public:
  Law() : Law(PowerLaw{0, 0}) {}
  Law(PowerLaw law) : Law(laws().front(), std::array{law.a, law.b}) {}  // NOLINT: it is one
  Law(TableLaw points) : points_(std::make_shared<const TableLaw>(std::move(points))) {}  // NOLINT
  Law(const LawForm& form, std::span<const double> c, double D_unit = 1, double v_unit = 1)
      : form_(&form), D_unit_(D_unit), v_unit_(v_unit) {
    for (std::size_t j = 0; j < size(); ++j) c_[j] = c[j];
  }
  /// The law of a search, whose coefficients are those of LawForm::searched.
  static Law searched(const LawForm& form, std::span<const double> c, double D_unit,
                      double v_unit) {
    Law law(form, c, D_unit, v_unit);
    law.of_search_ = form.written != nullptr;
    return law;
  }

  /// The same law in a wind of w [m/s] against the motion: its term d2 v^2 becomes
  /// d2 (v + w)|v + w|. D may then be below 0. A law without this term stays as it is.
  Law in_wind(double w) const {
    Law other = *this;
    other.wind_ = has_drag() ? w : 0;
    other.calm_ = -other.wind_;
    return other;
  }
  bool has_drag() const { return form_ && form_->drag >= 0; }
  double wind() const { return wind_; }
  /// The part of D that the drag of the air is, at a velocity.
  double air(double v) const { return has_drag() ? drag() * (v + wind_) * std::abs(v + wind_) : 0; }
  /// The derivative of D by the wind, at v >= 0; and the part of D that air at rest, blown at by
  /// this wind alone, has.
  double by_wind(double v) const { return has_drag() ? 2 * drag() * std::abs(v + wind_) : 0; }
  double blast() const { return wind_ == 0 ? 0 : drag() * wind_ * wind_; }

  /// The law a v^b that this is, if it is one.
  std::optional<PowerLaw> power() const {
    if (form_ != &laws().front()) return {};
    return PowerLaw{D_unit_ * c_[0] * std::pow(v_unit_, -c_[1]), c_[1]};
  }
  bool has_points() const { return points_ != nullptr; }
  /// The number of coefficients; 0 for points.
  std::size_t size() const { return form_ ? form_->coefficients.size() : 0; }
  const LawForm& form() const { return *form_; }
  /// Coefficient j of the formula or of the search, in the law's units.
  double c(std::size_t j) const { return c_[j]; }
  /// D and v dD/dv at v >= 0 [m/s], and the derivatives of D by the coefficients. Above highest()
  /// the points continue, only for the trial steps of a solver.
  Shift at(double v, double* by_c) const {
    if (points_) return points_->at(v);
    const LawForm& known = *form_;  // NOLINT(clang-analyzer-core.NullDereference): no points
    Shift s = (of_search_ ? known.searched : known.shift)(c_.data(), v / v_unit_, by_c);
    if (wind_ != 0) blow(v / v_unit_, s, by_c);
    for (std::size_t j = 0; j < size(); ++j) by_c[j] *= D_unit_;
    return {D_unit_ * s.D, D_unit_ * s.by_log_v};
  }
  Shift at(double v) const {
    double unused[LawForm::most];
    return at(v, unused);
  }
  /// D at a velocity: it has the sign of v and is 0 at rest. The wind is against a v above 0.
  double operator()(double v) const {
    if (v < 0 && wind_ != 0) return -in_wind(-wind_)(-v);
    return v == 0 ? 0 : std::copysign(1.0, v) * at(std::abs(v)).D;
  }
  /// The limit of D for v -> 0, which may be infinite.
  double at_rest() const { return at(0).D; }
  /// The largest speed for which the law is defined.
  double highest() const { return points_ ? points_->speeds().back() : INFINITY; }
  /// Throws Error for a speed above that by more than the error of a roll.
  void check_speed(double v) const;
  /// The speeds, in increasing order, where a derivative of the law jumps.
  std::span<const double> corners() const {
    if (points_) return points_->speeds();
    return wind_ < 0 ? std::span<const double>(&calm_, 1) : std::span<const double>();
  }
  /// Coefficient j of the formula in SI units, and its derivatives by c.
  double in_SI(std::size_t j, std::span<double> by_c) const;

 private:
  double drag() const {
    return D_unit_ * c_[static_cast<std::size_t>(form_->drag)] / v_unit_ / v_unit_;
  }
  void blow(double v, Shift&, double* by_c) const;

  const LawForm* form_ = nullptr;
  bool of_search_ = false;  // by coefficients that are not those of the formula
  std::shared_ptr<const TableLaw> points_;
  std::array<double, LawForm::most> c_{};
  double D_unit_ = 1, v_unit_ = 1;
  double wind_ = 0;  // [m/s]
  double calm_ = 0;  // the speed at which the air rests beside the body
};

}  // namespace rolling
