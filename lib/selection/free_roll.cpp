// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/free_roll.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "selection/outliers.h"
#include "selection/pieces.h"
#include "selection/readings.h"

namespace rolling {
namespace {

/// Share of the largest speed below which a body may come to rest by itself.
constexpr double slow = 0.15;

/// Of RSS: 2.5 and 5 standard errors.
constexpr double rather = 6, five_sigma = 25;

/// Pieces that are one roll, by their indices.
struct Chain {
  std::size_t first, last;
  double duration = 0, fastest = 0, lost = 0;  ///< share of its speed that it loses
};

template <Quantity of>
class Search {
  static constexpr bool positions = of == Quantity::x;

 public:
  Search(std::span<const Sample> samples, double noise)
      : samples_(samples), noise_(noise), joints_(samples, noise) {
    const auto joints = best_partition<most_coefficients(of)>(samples, noise);
    for (std::size_t i = 1; i < joints.size(); ++i)
      pieces_.emplace_back(samples, joints[i - 1], joints[i], noise);
    for (const auto& p : pieces_)
      for (const double t : {p.from, p.middle(), p.to})
        if (const auto v = p.v(t); !p.is_short())
          fastest_ = std::max(fastest_, std::abs(v.value) - 3 * v.error);
  }

  std::optional<FreeRoll> roll() const {
    std::vector<Chain> chains = rolls();
    if (chains.empty()) return {};
    const auto rank = [](const Chain& c) { return std::pair(c.lost > 0.1, c.duration); };
    std::ranges::sort(chains, std::greater(), rank);
    const Chain& best = chains[0];
    FreeRoll found = kept(best);
    // A rest at the end of the run may be too short for a piece of its own.
    if (found.how == FreeRoll::End::goes_on && found.kept.end < samples_.size())
      found.how = FreeRoll::End::by_itself;
    const auto may_be = [&](const Chain& c) {
      return c.lost > 0.05 && (c.duration > 0.4 * best.duration ||
                               (c.duration > 0.1 * best.duration && c.last + 1 == best.first));
    };
    const auto other = std::find_if(chains.begin() + 1, chains.end(), may_be);
    if (other != chains.end()) found.other = kept(*other).kept;
    return found;
  }

 private:
  static double sign(double a) { return a < 0 ? -1 : 1; }

  std::vector<Chain> rolls() const {
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece<of>& p = pieces_[i];
      const auto a = p.a(p.middle());
      if (p.is_short() && std::abs(a.value) < 20 * a.error) continue;
      if (!chains.empty() && continues(pieces_[chains.back().last], p)) chains.back().last = i;
      else if (!p.is_short() && is_roll(p)) chains.push_back({i, i});
    }
    for (Chain& c : chains) {
      const auto &a = pieces_[c.first], &b = pieces_[c.last];
      const double v0 = a.v(a.from).value, v1 = b.v(b.to).value;
      c.duration = b.to - a.from;
      c.fastest = std::max(std::abs(v0), std::abs(v1));
      c.lost = std::abs(v0 - v1) / c.fastest;
    }
    std::erase_if(chains, [&](const Chain& c) {
      return c.fastest < 0.2 * fastest_ || !stands_out(pieces_[c.first], pieces_[c.last]);
    });
    return chains;
  }

  /// Of noise alone, a piece in some thousand would.
  bool stands_out(const Piece<of>& a, const Piece<of>& b) const {
    if (!positions) return std::abs(a.v(a.from).value) > 5 * noise_;
    const auto way = [&](const Piece<of>& in, double t) {
      return std::abs(in.y(t).value - a.y(a.from).value);
    };
    return std::max({way(b, b.to), way(a, a.to), way(a, a.middle())}) > 12 * noise_;
  }
  /// Whether the body slows down, or turns and comes back.
  bool is_roll(const Piece<of>& p) const {
    const auto v0 = p.v(p.from), v1 = p.v(p.to), v = p.v(p.middle()), a = p.a(p.middle());
    if (!(std::abs(a.value) > 4 * a.error)) return false;
    if (v0.value * v1.value < 0 && v0.is_known() && comes_back(p, sign(a.value)))
      return v0.value * a.value < 0 && std::abs(v1.value) < 1.1 * std::abs(v0.value);
    return v.value * a.value < 0 && v.is_known() && std::abs(v.value) > 0.03 * fastest_;
  }
  bool comes_back(const Piece<of>& p, double way) const {
    const auto v = p.v(p.to);
    if (!v.is_known()) return false;
    if (!positions) return v.value * way > 0.15 * fastest_;
    return v.value * way > 0.03 * fastest_ && stands_out(p, p);
  }

  /// Whether the motion of a goes on in b under one law, whatever lies between.
  bool continues(const Piece<of>& a, const Piece<of>& b) const {
    if (b.from - a.to > std::min(a.duration(), b.duration())) return false;
    const double t = std::midpoint(a.to, b.from);
    const auto jump = [](auto p, auto q) { return std::abs(p.value - q.value); };
    const auto error = [](auto p, auto q) { return std::hypot(p.error, q.error); };
    const auto va = a.v(t), vb = b.v(t);
    const auto ma = a.a(a.middle()), mb = b.a(b.middle());
    const double ratio = mb.value / ma.value, way = sign(ma.value);
    // On a slight slope the way back is steady: D is as large as the slope allows.
    const bool turns = va.value * way > -0.25 * fastest_ && comes_back(b, way);
    if (!(ratio > 0) && !(turns && std::abs(mb.value) <= 3 * mb.error)) return false;
    if (jump(va, vb) > 4 * error(va, vb) + (turns ? 0.1 : 0.03) * fastest_) return false;
    if (turns) return ratio < 1.2;  // D is against the motion on both ways
    const bool stops = mb.is_known() && std::abs(b.v(b.to).value) < 0.03 * fastest_;
    if (va.value * way < 0 && !stops && !is_roll(b)) return false;
    const auto ea = a.a(a.to), eb = b.a(b.from);
    const double larger = std::max(std::abs(ea.value), std::abs(eb.value));
    const double most = ratio > 1 ? 0.2 : 0.4;
    if (error(ea, eb) < 0.15 * larger)
      return ratio > 0.2 && ratio < 5 && jump(ea, eb) < std::max(most * larger, 3 * error(ea, eb));
    return ratio > 0.55 && ratio < 1.5;
  }

  FreeRoll::End end_of(const Chain& c) const {
    const Piece<of>& last = pieces_[c.last];
    if (last.end == samples_.size()) return FreeRoll::End::goes_on;
    const auto v = last.v(last.to);
    const auto back = last.v(last.middle());
    if (back.is_known() && back.value * pieces_[c.first].v(pieces_[c.first].from).value < 0)
      return FreeRoll::End::is_ended;
    return std::abs(v.value) < std::max(3 * v.error, slow * c.fastest) ? FreeRoll::End::by_itself
                                                                       : FreeRoll::End::is_ended;
  }

  /// The samples that belong to a roll whatever their noise.
  FreeRoll kept(const Chain& c) const {
    const Piece<of>&first = pieces_[c.first], &last = pieces_[c.last];
    Stretch s{first.begin, last.end};
    FreeRoll::End how = end_of(c);
    double sudden = INFINITY;  // RSS of an end with a jump
    if (s.begin > 0) {
      const Piece<of>& before = pieces_[c.first - 1];
      const auto cost = joints_.costs(before.begin, before.order, first.order, first.end);
      s.begin = before.begin + joints_.inner(cost, before.size(), first.size() / 3, 1);
      s.begin = std::max(s.begin, first.end - joints_.agreeing(first.end - 1, first.begin));
      // A speed is made of positions on either side of its time, also of one before the joint.
      const double begin = samples_[s.begin].t,
                   joint = positions ? std::midpoint(samples_[s.begin - 1].t, begin) : begin,
                   t = joint + std::max(unseen(first, begin), unseen_push(before, first));
      while (samples_[s.begin].t < std::min(t, first.to)) ++s.begin;
    }
    if (s.end < samples_.size()) {
      const Piece<of>& next = pieces_[c.last + 1];
      const auto cost = joints_.costs(last.begin, last.order, next.order, next.end);
      sudden = *std::min_element(cost.begin(), cost.end());
      s.end = last.begin + joints_.inner(cost, last.size(), last.size() / 3, -1);
      s.end = std::min(s.end, last.begin + joints_.agreeing(last.begin, last.end - 1));
    }
    if (how != FreeRoll::End::is_ended && std::abs(last.v(last.to).value) < slow * c.fastest)
      how = slow_end(c, how, sudden, s);
    if (how == FreeRoll::End::is_ended) {
      const double t = samples_[s.end - 1].t - unseen(last, samples_[s.end - 1].t);
      while (s.end > std::max(last.begin, s.begin) + 1 && samples_[s.end - 1].t > t) --s.end;
    }
    // The rows that decided are not kept, which would bias a and b; and what a sensor makes of
    // several positions knows of a row behind the joint.
    const std::size_t spare = std::min<std::size_t>(positions ? 1 : 2, (s.end - s.begin) / 25);
    if (s.begin > 0) s.begin += spare;
    if (s.end < samples_.size()) s.end -= spare;
    // A step of rounded readings tells the place of the body; amid equal ones their errors cancel.
    const auto equal = [&](std::size_t i) { return samples_[i].y == samples_[i - 1].y; };
    for (std::size_t end = s.end, from, to = end; end > s.begin; end = to = from) {
      for (from = end - 1; from > s.begin && equal(from);) --from;
      while (to < samples_.size() && equal(to)) ++to;
      if ((from + to + 1) / 2 > s.end) continue;
      s.end = (from + to + 1) / 2;
      break;
    }
    return {s, how, samples_[std::min(last.end, samples_.size() - 1)].t};
  }

  /// Of a roll that is slow at its end: how it ends, and where. `sudden`: RSS of an end with a
  /// jump.
  FreeRoll::End slow_end(const Chain& c, FreeRoll::End how, double sudden, Stretch& s) const {
    const Piece<of>& last = pieces_[c.last];
    const std::size_t end = s.end < samples_.size() ? pieces_[c.last + 1].end : last.end;
    const auto [stop, rss] = joints_.before_stop(last.begin, last.end, end);
    if (rss > sudden + five_sigma) how = FreeRoll::End::is_ended;
    else s.end = stop;
    // A hand that slows a slow body by hardly more than D may seem to be the last piece, or of it.
    const std::size_t before = std::max(c.first + 1, c.last) - 1,
                      begin = std::max(s.begin, pieces_[before].begin);
    double any = five_sigma;  // RSS of what agrees with the readings as well as the pieces do
    for (const Piece<of>& p : std::span(pieces_).subspan(before))
      if (p.end <= end) any += p.rss();
    const double by_itself = joints_.before_stop(begin, last.end, end).second;
    const auto [hand, by_hand] = joints_.before_hand(begin, last.end, end);
    if (by_hand > any || by_hand > by_itself - rather) return how;
    s.end = std::min(s.end, hand);
    return by_hand > by_itself - five_sigma ? how : FreeRoll::End::is_ended;
  }

  /// The time for which positions do not show a change: a body that a hand moves from rest to v, or
  /// back, within T deviates from the sudden change by v T/8 at most.
  double unseen(const Piece<of>& p, double t) const {
    const double time = positions ? 12 * noise_ / std::abs(p.v(t).value) : 0;
    return std::min(time, p.duration() / 4);
  }

  /// The same for the end of a push of the duration T, whose force fades: its speed is
  /// v (1 + cos(pi s/T))/2 before the release, which moves the body by v pi^2 s^3/(12 T^2) less.
  double unseen_push(const Piece<of>& push, const Piece<of>& roll) const {
    if (!push.a(push.middle()).is_known()) return 0;
    const double v = std::abs(roll.v(roll.from).value), T = push.duration(), share = 2 * noise_ / v;
    const double s = positions ? std::cbrt(12 * share * T * T / 9.87) : T * std::sqrt(share / 2.47);
    return std::min({s, T / 2, roll.duration() / 8});
  }

  std::span<const Sample> samples_;
  double noise_, fastest_ = 0;
  Joints<of> joints_;
  std::vector<Piece<of>> pieces_;
};

/// The means of t and y over consecutive blocks of `size` samples, from those of the first sample
/// on, positions too; an incomplete last block is dropped.
std::vector<Sample> means(std::span<const Sample> run, std::size_t size, bool positions) {
  const Sample origin{run[0].t, positions ? run[0].y : 0};
  std::vector<Sample> blocks;
  for (std::size_t i = 0; i + size <= run.size(); i += size) {
    const Sample& begin = run[i];  // means of differences from it lose no digits
    double t = 0, y = 0;
    for (const Sample& s : run.subspan(i, size)) t += s.t - begin.t, y += s.y - begin.y;
    blocks.push_back({begin.t - origin.t + t / static_cast<double>(size),
                      begin.y - origin.y + y / static_cast<double>(size)});
  }
  return blocks;
}

/// The roll in the means of so many samples each.
FreeRoll roll_in_means(std::span<const Sample> run, bool positions, std::size_t size) {
  constexpr double off = 6;  // standard errors
  std::vector<double> y;     // of the first sample of each mean
  for (std::size_t i = 0; i < run.size(); i += size) y.push_back(run[i].y);
  // Speeds that a sensor takes from rounded positions have errors that follow each other.
  const double step = positions  ? grid_of(y)
                      : size > 1 ? 2 * grid_of(y) / static_cast<double>(size)
                                 : 0;
  const bool held = are_held(y);
  const std::vector<Sample> readings = means(run, size, positions);
  const Units units(readings);
  std::vector<Sample> samples;     // those that are on the motion of their neighbours
  std::vector<std::size_t> index;  // in the run, of their first
  Outliers outliers({201, 0}, off);
  std::size_t i = 0;
  const auto take = [&](std::span<const Sample> judged) {
    for (const Sample& s : judged) {
      while (readings[i].t < s.t) ++i;
      // The last reading is beyond its neighbours: a stop there looks like an outlier.
      if (!std::isnan(s.y) || i + 1 == readings.size())
        samples.push_back(units(readings[i])), index.push_back(i * size);
    }
  };
  for (std::size_t k = 0; k < readings.size(); ++k)  // of held readings the first alone is one
    if (!held || k == 0 || k + 1 == readings.size() || readings[k].y != readings[k - 1].y)
      take(outliers.push(readings[k].t, readings[k].y));
  take(outliers.finish());
  const double noise = noise_of(samples, positions, std::ldexp(step, -units.y));
  const auto found = positions ? Search<Quantity::x>(samples, noise).roll()
                               : Search<Quantity::v>(samples, noise).roll();
  if (!found) {
    const auto [low, high] = std::ranges::minmax(y);
    fail(
        "no free roll is found: the readings go from {:.4g} to {:.4g}, and no motion in them that "
        "slows down stands out of their noise of {:.1g}: choose the roll by its times (--from, "
        "--to)",
        low, high, std::ldexp(noise, units.y));
  }
  FreeRoll roll = *found;
  const auto of_run = [&](const Stretch& s) {
    const std::size_t begin = index[s.begin],
                      end = s.end == samples.size() ? run.size() : index[s.end - 1] + size;
    return Stretch{begin, end, run[begin].t, run[end - 1].t};
  };
  roll.kept = of_run(roll.kept);
  if (roll.other) roll.other = of_run(*roll.other);
  roll.after = std::ldexp(roll.after, units.t) + run[0].t;
  return roll;
}

}  // namespace

FreeRoll free_roll(std::span<const Sample> run, bool positions) {
  constexpr std::size_t at_once = 1000;
  const std::size_t n = run.size(), size = (n + at_once - 1) / at_once;
  if (n < 10) fail("a run of {} rows is too short to find its free roll", n);
  FreeRoll roll = roll_in_means(run, positions, size);
  if (size == 1) return roll;
  // As much on either side as the roll is long shows its beginning and its end. If that is more
  // than half of the run, a second search would see little more.
  const std::size_t around = std::max(roll.kept.end - roll.kept.begin, 20 * size),
                    from = roll.kept.begin - std::min(around, roll.kept.begin),
                    to = std::min(roll.kept.end + around, n);
  if (to - from > n / 2) return roll;
  const auto other = roll.other;
  roll = free_roll(run.subspan(from, to - from), positions);
  roll.kept.begin += from, roll.kept.end += from;
  if (roll.how == FreeRoll::End::goes_on && to < n) roll.how = FreeRoll::End::is_ended;
  roll.other = other;
  return roll;
}

}  // namespace rolling
