// Do the runs of a joint fit agree, and what are its errors worth where they do not?
#pragma once

#include "fit/errors.h"

namespace rolling {

/// Each run is fitted by itself, with a and b of its own (the slope of the mat is held at that of
/// all runs), and compared with the mean of all, weighted by the inverse covariances of its own
/// errors, whatever their kind. None where fewer than two runs determine a law by themselves.
///
/// `errors` are those of the joint fit. Where the runs disagree, a and b of `joint` become the
/// means of ln a and of b of the runs, each weighted by its own errors: one law for all bends
/// between them (by 2 % of scatter in a, b would be off by its error), and the correlations of the
/// errors would carry the scatter of one into the mean of the other. Their errors become those of
/// the means, each multiplied by its scale factor sqrt(chi^2/(N - 1)), if that is above 1, after
/// the Particle Data Group (Review of Particle Physics, section "Unconstrained averaging"); and,
/// since N runs tell the factor only roughly, by t/1.96, t Student's quantile of 0.975 for N - 1
/// degrees of freedom: so 1.96 standard errors hold the truth in 95 % (JCGM 100:2008, G.3).
///
/// The errors of v0 and of the slope of the mat, which stay those of the joint fit, are those of
/// the noise around the runs' own laws, multiplied by the factor of the D that is known best. A
/// fitted slope takes a degree of freedom; two runs then have none left, and all errors are
/// multiplied by the sqrt(chi^2/dof) of all.
std::optional<Agreement> agreement_of(Route, const std::vector<FitRun>&, const FitOptions&,
                                      NoiseErrors& errors, Fitted& joint);

}  // namespace rolling
