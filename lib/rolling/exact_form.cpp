#include "rolling/exact_form.h"

#include <cmath>

#include "base/error.h"

namespace rolling {

ExactForm::ExactForm(const Body& body, PowerLaw law, double v0, double x0) : trajectory_(body, Geometry::exact, law, v0), x0_(x0) {
  if (!std::isfinite(x0)) fail("the initial position x0 = {} must be finite", x0);
  seek(0);
}

void ExactForm::seek(double t) {
  t_ = t;
  lambda_ = trajectory_.log_ratio(t);
}

}  // namespace rolling
