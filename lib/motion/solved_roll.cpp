#include "motion/solved_roll.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "contact/contact.h"

namespace rolling {

namespace {

const std::vector<double>& checked(const std::vector<double>& start) {
  if (!std::isfinite(start[0])) fail("the initial position x0 = {} must be finite", start[0]);
  return start;
}

}  // namespace

SolvedRoll::SolvedRoll(const Body& body, Geometry geometry, OdeSystem equations,
                       const OdeOptions& options, std::vector<double> start)
    : body_(body), geometry_(geometry), equations_(std::move(equations)), options_(options),
      start_(std::move(start)), ode_(equations_, options_, 0, checked(start_)) {}

double SolvedRoll::acceleration() {
  return at_rest() ? 0 : acceleration_from_shift(body_, geometry_, shift());
}

}  // namespace rolling
