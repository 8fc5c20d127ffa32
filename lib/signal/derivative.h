// The time derivative of a column, one sample in at a time. All of these throw Error for a run of
// one sample.
#pragma once

#include <array>
#include <span>

#include "signal/method.h"

namespace rolling {

/// Of the parabola through three neighbouring samples at any spacing: at the middle one inside (the
/// central difference), at the outer one at the ends. Second order in the spacing, exact on a
/// parabola. A run of two samples has their slope.
class CentralDerivative : public Signal {
 public:
  std::span<const double> push(double t, double y) override;
  std::span<const double> finish() override;

 private:
  std::size_t count_ = 0;
  double t_ = 0, y_ = 0;         // the last sample
  double step_ = 0, slope_ = 0;  // from the one before it
  double bend_ = 0;              // half of the parabola's second derivative
  std::array<double, 2> known_{};
};

/// As Vernier's programs do it: the slopes over one, two and three samples to either side, weighted
/// 3, 2, 1; a sample beyond the end of the run is the one at the end. The weights are those by
/// which an export of such a program, 304 records, comes out to the last bit (tests/recordings.md).
class VernierDerivative : public WindowedSignal<VernierDerivative> {
 public:
  VernierDerivative() : WindowedSignal({7, 0}, Windows::Ends::cut) {}
  double value(const Windows&);
};

/// As PASCO's programs do it, by an export whose speeds come out to the rounding of its positions
/// (tests/recordings.md): (y[i+1] + y[i+2] - y[i-1] - y[i-2]) / (6 dt), the times in place of
/// the y below the line. The second sample and the last but one have the slope between their
/// neighbours, as there; the first and the last, which have none there, that of the parabola
/// through three samples.
class PascoDerivative : public WindowedSignal<PascoDerivative> {
 public:
  PascoDerivative() : WindowedSignal({5, 0}, Windows::Ends::cut) {}
  double value(const Windows&);
};

/// central, savgol (the only one that has a width), spline, vernier and pasco.
extern const std::span<const SignalMethod> derivative_methods;

}  // namespace rolling
