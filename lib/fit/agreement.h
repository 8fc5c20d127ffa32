// Do the runs of a joint fit agree, and what are its errors worth where they do not?
#pragma once

#include "fit/errors.h"

namespace rolling {

/// Each run is fitted by itself, with a and b of its own (the slope of the mat is held at that of
/// all runs), and compared with the mean of all, weighted by the inverse covariances of its own
/// errors. None where fewer than two runs determine a law by themselves. `errors` are those of the
/// joint fit; where the runs disagree they become those of the noise around the runs' own laws,
/// or those that the scatter of the runs brings to a number, where these are larger:
///
/// The scatter is that of what each run does to the joint fit, freed of its own weight there (Bell
/// and McCaffrey 2002, Survey Methodology 28, 169). For runs of equal weight and one parameter the
/// factor is the sqrt(chi^2/(N - 1)) of the Particle Data Group (Review of Particle Physics,
/// section "Unconstrained averaging"). It is known from few runs only: it is multiplied by
/// t/1.96, t Student's quantile for N - 1 degrees of freedom, so that 1.96 standard errors hold the
/// truth in 95 % (JCGM 100:2008, G.3). One degree less where the slope is fitted; where none is
/// left, the factor is the plain sqrt(chi^2/dof).
std::optional<Agreement> agreement_of(Route, const std::vector<FitRun>&, const FitOptions&,
                                      const Fitted& joint, Uncertainty& errors);

}  // namespace rolling
