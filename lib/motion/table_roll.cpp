#include "motion/table_roll.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"
#include "motion/gauss_legendre.h"
#include "motion/trajectory.h"

namespace rolling {

namespace {

constexpr int panels_in_a_piece = 4;  // short ones, in which Newton's method needs few steps
constexpr int most_halvings = 30;     // of a panel

}  // namespace

bool always_slows(const Body& body, Geometry geometry, const TableLaw& law, double v0) {
  if (body.slope >= 0) return true;
  const auto slows = [&](double v) {  // D is monotone between two points
    return acceleration_from_shift(body, geometry, law(v)) < 0;
  };
  return slows(0) && slows(v0) &&
         std::all_of(law.speeds().begin(), law.speeds().end(),
                     [&](double v) { return v > v0 || slows(v); });
}

TableRoll::TableRoll(const Body& body, Geometry geometry, TableLaw law, double v0, double x0)
    : body_(body), geometry_(geometry), law_(std::move(law)), v0_(v0), x0_(x0), v_(v0) {
  if (v0 > law_.highest())
    fail("the initial velocity v0 = {} is above the table of the law, which ends at {}", v0,
         law_.highest());
  check_roll(body, {law_.largest_shift(v0), 0}, v0);
  if (!always_slows(body, geometry, law_, v0))
    fail(
        "on this slope the law of the table does not slow the body at every speed: the method is a "
        "solver");
  std::vector<double> ends{0};  // of the pieces
  for (const double v : law_.speeds())
    if (v > 0 && v < v0) ends.push_back(v);
  panels_ = {{v0, 0, 0}};
  for (auto end = ends.rbegin(); v0 > 0 && end != ends.rend(); ++end) {
    const double from = panels_.back().v;
    for (int i = 1; i < panels_in_a_piece; ++i)
      add_panels(from + (*end - from) * i / panels_in_a_piece, 0);
    add_panels(*end, 0);
  }
}

/// Adds panels from the last speed down to `to`. The law is a cubic between two points of the
/// table; the integrand has poles where it is 0, or balances a slope. A panel is halved until the
/// sum of its halves agrees with the whole.
void TableRoll::add_panels(double to, int halvings) {
  const Panel last = panels_.back();
  const Integrals whole = integrals(last.v, to);
  if (halvings < most_halvings) {
    const double middle = to + (last.v - to) / 2;
    const double halves = integrals(last.v, middle).time + integrals(middle, to).time;
    if (std::abs(halves - whole.time) > 1e-14 * (last.time + halves)) {
      add_panels(middle, halvings + 1);
      add_panels(to, halvings + 1);
      return;
    }
  }
  panels_.push_back({to, last.time + whole.time, last.distance + whole.distance});
}

/// |dt/du| [s^2/m] at the speed v; time and distance are integrals of it over speed (Eq. 12).
double TableRoll::inverse_acceleration(double v) const {
  return -1 / acceleration_from_shift(body_, geometry_, law_(v));
}

TableRoll::Integrals TableRoll::integrals(double from, double to) const {
  const double half = (from - to) / 2, middle = (from + to) / 2;
  Integrals sum{0, 0};
  for (const auto& [x, weight] : gauss_legendre) {
    const double u = middle + half * x, dt = weight * half * inverse_acceleration(u);
    sum.time += dt;
    sum.distance += dt * u;
  }
  return sum;
}

void TableRoll::seek(double t) {
  if (t >= stop_time()) {
    v_ = 0;
    panel_ = panels_.size() - 1;
    return;
  }
  const auto after = std::upper_bound(panels_.begin(), panels_.end(), t,
                                      [](double time, const Panel& p) { return time < p.time; });
  panel_ = static_cast<std::size_t>(after - panels_.begin()) - 1;
  const Panel &begin = panels_[panel_], &end = panels_[panel_ + 1];
  // Newton's method, from linear interpolation between the ends of the panel.
  v_ = begin.v + (end.v - begin.v) * (t - begin.time) / (end.time - begin.time);
  for (int i = 0; i < 20; ++i) {
    const double step = (integrals(begin.v, v_).time - (t - begin.time)) / inverse_acceleration(v_);
    v_ = std::clamp(v_ + step, end.v, begin.v);
    if (std::abs(step) <= 1e-9 * v_) break;  // convergence is quadratic
  }
}

double TableRoll::position() {
  return x0_ + panels_[panel_].distance + integrals(panels_[panel_].v, v_).distance;
}

double TableRoll::acceleration() {
  return v_ == 0 ? 0 : acceleration_from_shift(body_, geometry_, shift());
}

}  // namespace rolling
