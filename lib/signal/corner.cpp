#include "signal/corner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/median.h"

namespace rolling {
namespace {

constexpr std::size_t w = 4;  // speeds in a window

/// The change of speed over `duration` on the least-squares line through the speeds of a window.
double rise(std::span<const Sample> window, double duration) {
  double t = 0, y = 0, tt = 0, ty = 0;
  for (const Sample& s : window) t += s.t - window[0].t, y += s.y;
  t /= w, y /= w;
  for (const Sample& s : window) {
    const double from = s.t - window[0].t - t;
    tt += from * from, ty += from * (s.y - y);
  }
  return ty / tt * duration;
}

/// For each speed from number w on: the change of speed in the window before it minus half of the
/// change in the window after it.
std::vector<double> bends_of(std::span<const Sample> speeds) {
  std::vector<double> bends;
  for (std::size_t i = w; i + w <= speeds.size(); ++i) {
    const double duration = (speeds[i + w - 1].t - speeds[i - w].t) * w / (2 * w - 1);
    bends.push_back(rise(speeds.subspan(i - w, w), duration) -
                    rise(speeds.subspan(i, w), duration) / 2);
  }
  return bends;
}

/// The standard deviation of the bends from speed `first` on. If there are 20 or more, their own
/// scatter is a lower bound for it, because the noise need not be white.
double noise_of(std::span<const double> bends, std::span<const Sample> speeds, std::size_t first) {
  std::vector<double> seconds;
  for (std::size_t i = std::max<std::size_t>(first, 1); i + 1 < speeds.size(); ++i)
    seconds.push_back(std::abs(speeds[i + 1].y - 2 * speeds[i].y + speeds[i - 1].y));
  std::vector<double> own(bends.begin() + static_cast<std::ptrdiff_t>(std::max(first, w) - w),
                          bends.end());
  // For speeds with white noise of standard deviation 1, second differences have the standard
  // deviation sqrt(6), and the change of a least-squares line through w speeds over one window has
  // sqrt(12 w / (w^2 - 1)). The bend is a difference of two such changes with weights 1 and 1/2.
  double sigma = seconds.empty() ? 0
                                 : deviation(seconds) / std::sqrt(6.0) *
                                       std::sqrt(12.0 * w / (w * w - 1) * (1 + 0.25));
  if (own.size() < 20) return sigma;
  const double middle = median(own);
  for (double& bend : own) bend = std::abs(bend - middle);
  return std::max(sigma, 1.4826 * median(own));
}

/// The speed at which a corner is sharpest and the last one at which it is visible; 0 if there is
/// none.
struct Corner {
  std::size_t at = 0, last = 0;
};

/// The last corner of the speeds, at number `first` or later, that exceeds `least` and
/// `significance` standard deviations.
Corner last_corner(std::span<const Sample> speeds, std::size_t first, double least,
                   double significance) {
  const std::vector<double> bends = bends_of(speeds);
  if (bends.size() + w <= first || bends.empty()) return {};
  const double most = std::max(least, significance * noise_of(bends, speeds, first));
  std::size_t last = bends.size();
  while (last > 0 && last + w > first && !(bends[last - 1] > most)) --last;
  if (last == 0 || last + w <= first) return {};
  std::size_t at = last - 1;
  for (std::size_t i = last; i-- > 0 && bends[i] > most;)
    if (bends[i] > bends[at]) at = i;
  return {at + w, last - 1 + w};
}

std::vector<Sample> slopes(std::span<const Sample> way) {
  std::vector<Sample> speeds;
  for (std::size_t i = 1; i < way.size(); ++i)
    speeds.push_back({std::midpoint(way[i - 1].t, way[i].t),
                      (way[i].y - way[i - 1].y) / (way[i].t - way[i - 1].t)});
  return speeds;
}

}  // namespace

std::vector<Sample> means(std::span<const Sample> samples, std::size_t size) {
  std::vector<Sample> blocks;
  blocks.reserve(samples.size() / size);
  for (std::size_t i = 0; i + size <= samples.size(); i += size) {
    const Sample& begin = samples[i];  // means of differences from it lose no digits
    double t = 0, y = 0;
    for (const Sample& s : samples.subspan(i, size)) t += s.t - begin.t, y += s.y - begin.y;
    blocks.push_back(
        {begin.t + t / static_cast<double>(size), begin.y + y / static_cast<double>(size)});
  }
  return blocks;
}

std::size_t last_corner(std::span<const Sample> way, const CornerOptions& o) {
  std::size_t corner = 0, clear = 0, size = o.size;  // windows from `clear` on do not contain it
  for (auto blocks = means(way, size); blocks.size() > 2 * w;
       blocks = means(blocks, 2), size *= 2) {
    const std::vector<Sample> speeds = slopes(blocks);
    const std::size_t from = std::min((clear + size - 1) / size, speeds.size());
    const double coarse = o.coarse.rounding * std::pow(static_cast<double>(size), -o.coarse.power);
    const Corner found =
        last_corner(std::span(speeds).subspan(from), std::max(o.first / size, from) - from,
                    std::max(o.least, o.significance * coarse), o.significance);
    if (found.at == 0) continue;
    corner = (from + found.at) * size + size / 2;
    clear = (from + found.last + w / 2) * size + size / 2;
  }
  return corner;
}

}  // namespace rolling
