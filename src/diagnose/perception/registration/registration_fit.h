#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_block.h"

namespace tera {

/// How well the points hold one parameter of a term.
struct ParameterPrecision {
  double sigma = 0;  ///< standard deviation
  /// Posterior over prior standard deviation: near 1 the points say nothing of it.
  double prior_share = 0;

  bool is_determined() const { return prior_share < kUndetermined; }
  static constexpr double kUndetermined = 0.3;
};

/// Terms fitted to points.
struct RegistrationFit {
  Structure terms;
  std::vector<std::vector<ParameterPrecision>> precision;  ///< of each parameter of each term
};

/// Fits by Gauss and Newton, points associated anew in each of its rounds, coarse ones first: in
/// the coarsest what turns the sensor and its clock alone, since a place is soon lost among the
/// angles. Parameters that the points do not determine are put back to what the scenario has, held
/// there, and the others fitted again.
///
/// Model   Student-t noise of 4 degrees of freedom and `scale` times each point's sigma, approached
///         from a wide scale so that errors larger than noise are followed too; normal priors
///         (FreeParameter::prior_sigma) about the values of `start`. Standard deviations are the
///         larger of two: of independent points, and of the scatter of the scores of scans.
/// Source  Chen and Medioni 1992 (distance to planes); Lange, Little and Taylor 1989 (Student-t);
///         Huber 1967 (scatter of scores).
RegistrationFit FitRegistration(const RegistrationBlock& block,
                                const std::vector<ScanPoints>& points, const Structure& start,
                                double scale);

}  // namespace tera
