// Do the runs of a joint fit agree, and what are its errors worth where they do not?
#pragma once

#include "fit/errors.h"

namespace rolling {

/// Each run is fitted by itself, with a and b of its own (the slope of the mat is held at that of
/// all runs), and compared with the mean of all, weighted by the inverse covariances of its own
/// errors, whatever their kind. None where fewer than two runs determine a law by themselves.
///
/// `errors` are those of the joint fit. Where the runs disagree, a and b of `joint` become the
/// means of ln a and of b of the runs, for one law bends between them: by 2 % of scatter in a, b
/// would be off by its error. Each of the two numbers is taken to scatter from run to run by tau
/// beside the errors of the runs' own fits, with the tau that makes chi^2 as large as its degrees
/// of freedom (Mandel and Paule 1970, Anal. Chem. 42, 1194); the weights are 1/(sigma^2 + tau^2).
/// Since N runs tell tau only roughly, the errors of the means are multiplied by t/1.96, t
/// Student's quantile of 0.975 for N - 1 degrees of freedom: so 1.96 standard errors hold the truth
/// in 95 % (Hartung and Knapp 2001, Statist. Med. 20, 1771).
///
/// A slope of the mat that is fitted becomes the one at which the runs of both directions agree
/// best in ln D, by the same weights, and takes a degree of freedom. Two runs then have none left:
/// a, b and the slope stay those of the joint fit, and all errors are multiplied by the root of
/// chi^2/dof of all.
std::optional<Agreement> agreement_of(Route, const std::vector<FitRun>&, const FitOptions&,
                                      NoiseErrors& errors, Fitted& joint);

}  // namespace rolling
