#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_block.h"

namespace tera {

/// Precision of one parameter of a term from the points.
struct ParameterPrecision {
  double sigma = 0;  ///< standard deviation
  /// Posterior over prior standard deviation: near 1 the points carry no information on it.
  double prior_share = 0;

  bool is_determined() const { return prior_share < kUndetermined; }
  static constexpr double kUndetermined = 0.3;
};

/// Terms fitted to points.
struct RegistrationFit {
  Structure terms;
  std::vector<std::vector<ParameterPrecision>> precision;  ///< of each parameter of each term
};

/// Fits by Gauss-Newton with new associations in each iteration, from coarse to fine. The coarsest
/// level fits only rotation and clock, since a position is easily confused with angles.
/// Undetermined parameters return to the scenario's values and are held there, and the others are
/// refitted.
///
/// Model   Student-t noise of 4 degrees of freedom and `scale` times each point's sigma. The scale
///         starts wide, so that errors larger than the noise are followed too. Normal priors
///         (FreeParameter::prior_sigma) about the values of `start`. A standard deviation is the
///         larger of two: from independent points, and from the scatter of the scans' scores.
/// Source  Chen and Medioni 1992 (distance to planes); Lange, Little and Taylor 1989 (Student-t);
///         Huber 1967 (scatter of scores).
RegistrationFit FitRegistration(const RegistrationBlock& block,
                                const std::vector<ScanPoints>& points, const Structure& start,
                                double scale);

}  // namespace tera
