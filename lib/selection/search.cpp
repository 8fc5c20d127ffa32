// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "selection/joints.h"
#include "selection/pieces.h"
#include "selection/slowing.h"

namespace rolling {
namespace {

/// Share of the largest speed below which a body may come to rest by itself.
constexpr double slow = 0.15;

/// Motions differ by 2.5 and by 5 standard errors if their RSS differ by these numbers.
constexpr double rather = 6, five_sigma = 25;

/// Pieces that are one roll, by their indices.
struct Chain {
  std::size_t first, last;
  double duration = 0, fastest = 0, lost = 0;  ///< share of its speed that it loses
};

/// The rolls in samples of this noise.
class Search {
 public:
  Search(std::span<const Sample> samples, bool positions, double noise, std::size_t rows)
      : samples_(samples), positions_(positions), noise_(noise), rows_(rows),
        joints_(samples, positions, noise) {
    const auto joints = best_partition(samples, positions, noise);
    for (std::size_t i = 1; i < joints.size(); ++i) add_piece(joints[i - 1], joints[i]);
    for (const auto& p : pieces_)
      for (const double t : {p.from, p.middle(), p.to})
        if (const auto v = p.v(t); !p.is_short())
          fastest_ = std::max(fastest_, std::abs(v.value) - 3 * v.sigma);
  }

  /// The rolls that slow down alike, the longest first; it knows another stretch that may be meant.
  std::vector<FreeRoll> rolls() const {
    std::vector<Chain> all = chains();
    const auto rank = [](const Chain& c) { return std::pair(c.lost > 0.1, c.duration); };
    std::ranges::sort(all, std::greater(), rank);
    const std::vector<Chain> alike = of_one_law(all);
    std::vector<FreeRoll> found;
    Chain best{};
    for (const Chain& c : alike)
      if (const auto roll = kept(c)) {
        if (found.empty()) best = c;
        found.push_back(*roll);
      }
    if (found.empty()) return found;
    const auto may_be = [&](const Chain& c) {
      return c.first != best.first && c.lost > 0.05 &&
             (c.duration > 0.4 * best.duration ||
              (c.duration > 0.1 * best.duration && c.last + 1 == best.first));
    };
    const auto other = std::ranges::find_if(all, may_be);
    if (other != all.end())
      if (const auto roll = kept(*other)) found[0].other = roll->kept;
    return found;
  }

 private:
  /// Adds a piece, or two if the speed has a minimum amid it, and rises behind it by more than four
  /// standard errors: a free body slows down, so that the second part is driven. (A maximum may be
  /// one of a body on its way back down a slope, which nears its last speed.)
  void add_piece(std::size_t begin, std::size_t end) {
    const Piece p(samples_, positions_, begin, end, noise_);
    pieces_.push_back(p);
    const double first = p.a(p.from).value;
    const double last = p.a(p.to).value;
    if (first * last >= 0) return;
    const double t = std::lerp(p.from, p.to, first / (first - last));
    const auto v = p.v(t);
    const auto driven = p.v(p.to);
    const double rise = std::abs(driven.value) - std::abs(v.value);
    if (v.value * driven.value <= 0 || rise < 4 * std::hypot(v.sigma, driven.sigma)) return;
    std::size_t joint = begin;
    while (samples_[joint].t < t) ++joint;
    if (std::min(joint - begin, end - joint) < 5) return;
    pieces_.back() = Piece(samples_, positions_, begin, joint, noise_);
    pieces_.emplace_back(samples_, positions_, joint, end, noise_);
  }

  /// What a roll shows of its law, ordered by the speeds.
  std::vector<Slowing> law_of(const Chain& c) const {
    std::vector<Slowing> law;
    for (std::size_t i = c.first; i <= c.last; ++i)
      for (const double part : {1.0 / 6, 0.5, 5.0 / 6}) {
        const Piece& p = pieces_[i];
        const double t = std::lerp(p.from, p.to, part);
        const double v = p.v(t).value;
        if (!p.is_short()) law.push_back({std::abs(v), -p.a(t).value * sign(v), p.a(t).sigma});
      }
    std::ranges::sort(law, {}, &Slowing::v);
    return law;
  }
  /// The chains that slow down like one of them, within a factor of 1.5, for the longest time in
  /// all.
  std::vector<Chain> alike(const std::vector<Chain>& all) const {
    std::vector<std::vector<Slowing>> laws;
    for (const Chain& c : all) laws.push_back(law_of(c));
    std::vector<Chain> best;
    std::pair<bool, double> most{false, -1};
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::vector<Chain> found;
      double duration = 0;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (k == i || are_alike(laws[i], laws[k], 1.5)) {
          found.push_back(all[k]);
          duration += all[k].duration;
        }
      const std::pair worth(all[i].lost > 0.1, duration);
      if (worth <= most) continue;
      most = worth;
      best = found;
    }
    return best;
  }
  bool goes_up(const Chain& c) const { return pieces_[c.first].v(pieces_[c.first].from).value > 0; }
  /// The chains of one law. A body has one law; a hand, a brake or a body that is carried back
  /// follows another. On a mat that is not level the body slows down more on its way up than down:
  /// if all these chains go one way, those of the other way that are alike are of the body too, if
  /// they are two or more, take half as long in all, and slow down as much within a factor of 2.5.
  std::vector<Chain> of_one_law(const std::vector<Chain>& all) const {
    std::vector<Chain> best = alike(all);
    if (best.empty()) return best;
    const auto goes_back = [&](auto& c) { return goes_up(c) != goes_up(best.front()); };
    std::vector<Chain> back;
    std::copy_if(all.begin(), all.end(), std::back_inserter(back), goes_back);
    back = alike(back);
    const auto in_all = [](const auto& chains) {
      double duration = 0;
      for (const Chain& c : chains) duration += c.duration;
      return duration;
    };
    if (std::ranges::none_of(best, goes_back) && back.size() > 1 &&
        in_all(back) > in_all(best) / 2 &&
        are_alike(law_of(best.front()), law_of(back.front()), 2.5))
      best.insert(best.end(), back.begin(), back.end());
    double fastest = 0;
    for (const Chain& c : best) fastest = std::max(fastest, c.fastest);
    std::erase_if(best, [&](const Chain& c) { return c.fastest < 0.2 * fastest; });
    return best;
  }

  static double sign(double a) { return a < 0 ? -1 : 1; }

  std::vector<Chain> chains() const {
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& p = pieces_[i];
      const auto a = p.a(p.middle());
      if (p.is_short() && std::abs(a.value) < 20 * a.sigma) continue;
      if (!chains.empty() && continues(pieces_[chains.back().last], p)) chains.back().last = i;
      else if (!p.is_short() && is_roll(p)) chains.push_back({i, i});
    }
    for (Chain& c : chains) {
      const Piece& a = pieces_[c.first];
      const Piece& b = pieces_[c.last];
      const double v0 = a.v(a.from).value;
      const double v1 = b.v(b.to).value;
      c.duration = b.to - a.from;
      c.fastest = std::max(std::abs(v0), std::abs(v1));
      c.lost = std::abs(v0 - v1) / c.fastest;
    }
    std::erase_if(chains, [&](const Chain& c) {
      return c.fastest < 0.05 * fastest_ || !stands_out(pieces_[c.first], pieces_[c.last]);
    });
    return chains;
  }

  /// Whether the motion is far above the noise: the noise alone makes one such piece in some
  /// thousand.
  bool stands_out(const Piece& a, const Piece& b) const {
    if (!positions_) return std::abs(a.v(a.from).value) > 5 * noise_;
    const auto way = [&](const Piece& in, double t) {
      return std::abs(in.y(t).value - a.y(a.from).value);
    };
    return std::max({way(b, b.to), way(a, a.to), way(a, a.middle())}) > 12 * noise_;
  }
  /// Whether the body slows down, or turns and comes back.
  bool is_roll(const Piece& p) const {
    const auto v0 = p.v(p.from);
    const auto v1 = p.v(p.to);
    const auto v = p.v(p.middle());
    const auto a = p.a(p.middle());
    if (!(std::abs(a.value) > 4 * a.sigma)) return false;
    if (v0.value * v1.value < 0 && is_known(v0) && comes_back(p, sign(a.value)))
      return v0.value * a.value < 0 && std::abs(v1.value) < 1.1 * std::abs(v0.value);
    return v.value * a.value < 0 && is_known(v) && std::abs(v.value) > 0.03 * fastest_;
  }
  bool comes_back(const Piece& p, double way) const {
    const auto v = p.v(p.to);
    if (!is_known(v)) return false;
    if (!positions_) return v.value * way > 0.15 * fastest_;
    return v.value * way > 0.03 * fastest_ && stands_out(p, p);
  }

  /// Whether the motion of a goes on in b under one law. A few readings that are off may lie
  /// between them; more are another motion.
  bool continues(const Piece& a, const Piece& b) const {
    if (b.begin - a.end >= Piece::few) return false;
    if (b.from - a.to > std::min(a.duration(), b.duration())) return false;
    const double t = std::midpoint(a.to, b.from);
    const auto jump = [](auto p, auto q) { return std::abs(p.value - q.value); };
    const auto error = [](auto p, auto q) { return std::hypot(p.sigma, q.sigma); };
    const auto va = a.v(t);
    const auto vb = b.v(t);
    const auto ma = a.a(a.middle());
    const auto mb = b.a(b.middle());
    const double ratio = mb.value / ma.value;
    const double way = sign(ma.value);
    // On a slight slope the way back is steady: D is as large as the slope allows.
    const bool turns = va.value * way > -0.25 * fastest_ && comes_back(b, way);
    if (!(ratio > 0) && !(turns && std::abs(mb.value) <= 3 * mb.sigma)) return false;
    if (jump(va, vb) > 4 * error(va, vb) + (turns ? 0.1 : 0.03) * fastest_) return false;
    if (turns) return ratio < 1.2;  // D is against the motion on both ways
    const bool stops = is_known(mb) && std::abs(b.v(b.to).value) < 0.03 * fastest_;
    if (va.value * way < 0 && !stops && !is_roll(b)) return false;
    const auto ea = a.a(a.to);
    const auto eb = b.a(b.from);
    const double larger = std::max(std::abs(ea.value), std::abs(eb.value));
    const double most = ratio > 1 ? 0.2 : 0.4;
    if (error(ea, eb) < 0.15 * larger)
      return ratio > 0.2 && ratio < 5 && jump(ea, eb) < std::max(most * larger, 3 * error(ea, eb));
    return ratio > 0.55 && ratio < 1.5;
  }

  /// Whether the body may be at rest at the end.
  bool is_slow(const Chain& c) const {
    const Piece& last = pieces_[c.last];
    const auto v = last.v(last.to);
    return std::abs(v.value) < std::max(3 * v.sigma, slow * c.fastest);
  }

  FreeRoll::End end_of(const Chain& c) const {
    const Piece& last = pieces_[c.last];
    if (last.end == samples_.size()) return FreeRoll::End::goes_on;
    const auto back = last.v(last.middle());
    if (is_known(back) && back.value * pieces_[c.first].v(pieces_[c.first].from).value < 0)
      return FreeRoll::End::is_ended;
    return is_slow(c) ? FreeRoll::End::by_itself : FreeRoll::End::is_ended;
  }

  /// The samples of a roll whatever their noise; nothing if they are too few for a piece.
  std::optional<FreeRoll> kept(const Chain& c) const {
    Stretch s{begin_of(c), pieces_[c.last].end};
    FreeRoll::End how = set_end(c, s);
    // The rows that decided are not kept, which would bias a and b; a speed that a sensor makes of
    // several positions knows of a row behind the joint, a mean of as many as it is made of.
    const std::size_t spare =
        std::min<std::size_t>(positions_ ? 1 : 2, (s.end - s.begin) / 25) + rows_ / 2;
    if (s.end < s.begin + 2 * spare + Piece::few) return {};
    // A few positions at a low rate: the first may have been read amid the push.
    if (s.begin > 0) s.begin += std::max<std::size_t>(spare, positions_);
    if (s.end < samples_.size()) s.end -= spare;
    s.end = amid_equal(s);
    // A rest at the end of the run may be too short for a piece of its own.
    if (how == FreeRoll::End::goes_on && s.end < samples_.size() && is_slow(c))
      how = FreeRoll::End::by_itself;
    if (!positions_ && is_slow(c) && is_driven_behind(c)) how = FreeRoll::End::speeds_up;
    const double after = samples_[std::min(pieces_[c.last].end, samples_.size() - 1)].t;
    FreeRoll roll{s, how, after};
    if (how == FreeRoll::End::by_itself && !positions_) rest_or_not(c, roll);
    return roll;
  }

  /// Of speeds that seem to end at rest: they may stay at another one than 0, or fall on behind the
  /// end of the run. The errors of speeds that are made of positions follow each other: such a
  /// speed is one near which half of all that follow lie.
  void rest_or_not(const Chain& c, FreeRoll& roll) const {
    const bool at_end = pieces_[c.last].end == samples_.size();
    const Piece& next = pieces_[c.last + !at_end];
    const Estimate v = at_end ? Estimate{samples_.back().y, noise_ / 2} : next.v(next.middle());
    if (std::abs(v.value) < std::max(8 * v.sigma, noise_ / 3)) return;
    const auto behind = samples_.subspan(at_end ? samples_.size() - 1 : next.begin);
    const auto near = [&v](Sample s) { return std::abs(s.y - v.value) <= std::abs(v.value) / 2; };
    if (2 * std::ranges::count_if(behind, near) < std::ssize(behind)) return;
    roll.how = at_end ? FreeRoll::End::goes_on : FreeRoll::End::stays;
    roll.speed = v.value;
  }

  /// The first sample behind the push, wherever the joint lies.
  std::size_t begin_of(const Chain& c) const {
    const Piece& first = pieces_[c.first];
    if (first.begin == 0) return 0;
    const Piece& before = pieces_[c.first - 1];
    const auto cost = joints_.costs(before.begin, before.order, first.order, first.end);
    std::size_t begin = before.begin + joints_.inner(cost, before.size(), first.size() / 3, 1);
    begin = std::max(begin, first.end - joints_.agreeing(first.end - 1, first.begin));
    // A speed is made of positions on either side of its time, also of one before the joint.
    const double t = samples_[begin].t;
    const double joint = positions_ ? std::midpoint(samples_[begin - 1].t, t) : t;
    const double seen =
        joint + std::max(joints_.unseen(first, t), joints_.unseen_push(before, first));
    while (samples_[begin].t < std::min(seen, first.to)) ++begin;
    return begin;
  }

  /// Sets the end of the samples `s` before the stop, the hand, ..., and says which it is.
  FreeRoll::End set_end(const Chain& c, Stretch& s) const {
    const Piece& last = pieces_[c.last];
    FreeRoll::End how = end_of(c);
    double sudden = INFINITY;  // RSS of an end with a jump
    if (s.end < samples_.size()) {
      const Piece& next = pieces_[c.last + 1];
      const auto cost = joints_.costs(last.begin, last.order, next.order, next.end);
      sudden = *std::min_element(cost.begin(), cost.end());
      s.end = last.begin + joints_.inner(cost, last.size(), last.size() / 3, -1);
      s.end = std::min(s.end, last.begin + joints_.agreeing(last.begin, last.end - 1));
    }
    if (how != FreeRoll::End::is_ended && std::abs(last.v(last.to).value) < slow * c.fastest)
      how = slow_end(c, how, sudden, s);
    else if (is_driven_behind(c)) s.end = std::min(s.end, before_held(last));
    if (how == FreeRoll::End::is_ended) {
      const double t = samples_[s.end - 1].t - joints_.unseen(last, samples_[s.end - 1].t);
      while (s.end > std::max(last.begin, s.begin) + 1 && samples_[s.end - 1].t > t) --s.end;
    }
    return how;
  }

  /// Whether the speed rises behind the roll.
  bool is_driven_behind(const Chain& c) const {
    if (pieces_[c.last].end == samples_.size()) return false;
    const Piece& next = pieces_[c.last + 1];
    const auto a = next.a(next.middle());
    return is_known(a) && a.value * next.v(next.middle()).value > 0;
  }
  /// The end of the roll in the last piece before the body is driven: it may have been held at its
  /// last speed for a moment. If a fifth of the piece could be that, the readings say nothing.
  std::size_t before_held(const Piece& last) const {
    if (positions_) return last.end;
    const std::size_t held = joints_.before_stop(last.begin, last.end, last.end).end;
    return last.end - held < last.size() / 5 ? held : last.end;
  }

  /// The end of the stretch, moved back to the middle of equal readings: a step of rounded readings
  /// shows where the body is, and its rounding error is therefore no chance. Amid equal readings
  /// the errors cancel.
  std::size_t amid_equal(const Stretch& s) const {
    const auto equal = [&](std::size_t i) { return samples_[i].y == samples_[i - 1].y; };
    std::size_t to = s.end;
    while (to < samples_.size() && equal(to)) ++to;
    for (std::size_t end = s.end; end > s.begin;) {
      std::size_t from = end - 1;
      while (from > s.begin && equal(from)) --from;
      const std::size_t middle = (from + to + 1) / 2;
      if (middle <= s.end) return middle;
      end = to = from;
    }
    return s.end;
  }

  /// How a roll ends that is slow at its end, and where. `sudden` is the RSS of an end at which the
  /// speed jumps.
  FreeRoll::End slow_end(const Chain& c, FreeRoll::End how, double sudden, Stretch& s) const {
    const Piece& last = pieces_[c.last];
    const std::size_t end = s.end < samples_.size() ? pieces_[c.last + 1].end : last.end;
    const auto [stop, rss] = joints_.before_stop(last.begin, last.end, end);
    if (rss > sudden + five_sigma) how = FreeRoll::End::is_ended;
    else s.end = stop;
    // A hand that slows a slow body by hardly more than D may seem to be the last piece, or of it.
    const std::size_t before = std::max(c.first + 1, c.last) - 1;
    const std::size_t begin = std::max(s.begin, pieces_[before].begin);
    double any = five_sigma;  // RSS of what agrees with the readings as well as the pieces do
    for (const Piece& p : std::span(pieces_).subspan(before))
      if (p.end <= end) any += p.rss();
    const double by_itself = joints_.before_stop(begin, last.end, end).rss;
    const auto [hand, by_hand] = joints_.before_hand(begin, last.end, end);
    if (by_hand > any || by_hand > by_itself - rather) return how;
    s.end = std::min(s.end, hand);
    return by_hand > by_itself - five_sigma ? how : FreeRoll::End::is_ended;
  }

  std::span<const Sample> samples_;
  bool positions_;
  double noise_;
  std::size_t rows_;
  double fastest_ = 0;
  Joints joints_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<FreeRoll> search_rolls(std::span<const Sample> samples, bool positions, double noise,
                                   std::size_t rows) {
  return Search(samples, positions, noise, rows).rolls();
}

}  // namespace rolling
