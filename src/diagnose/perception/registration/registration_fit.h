#pragma once

#include <vector>

#include "diagnose/perception/registration/registration_block.h"

namespace tera {

/// Precision of one parameter of a term, estimated from the points.
struct ParameterPrecision {
  double sigma = 0;  ///< standard deviation
  /// Ratio of posterior to prior standard deviation. Near 1, the points carry no information on the
  /// parameter.
  double prior_share = 0;

  bool is_determined() const { return prior_share < kUndetermined; }
  static constexpr double kUndetermined = 0.3;
};

/// Terms fitted to points.
struct RegistrationFit {
  Structure terms;
  /// First index: term; second index: parameter.
  std::vector<std::vector<ParameterPrecision>> precision;
};

/// Fits terms by Gauss-Newton, from the coarsest to the finest level. Every iteration re-associates
/// the points. Level 3 fits only parameters that rotate the sensor or shift its clock, because a
/// shift in position resembles a rotation there. Undetermined parameters return to the scenario's
/// values and are held, and the others are refitted.
///
/// Model   Noise is Student's t with 4 degrees of freedom and `scale` times each point's sigma. The
///         scale starts wide, so that errors larger than the noise still attract the fit. Priors
///         are normal, about the values of `start` (FreeParameter::prior_sigma). Each standard
///         deviation is the larger of two estimates: from independent points, and from the scatter
///         of scores between scans.
/// Source  Chen and Medioni 1992 (point-to-plane distance); Lange, Little and Taylor 1989
///         (Student-t); Huber 1967 (scatter of scores).
RegistrationFit FitRegistration(const RegistrationBlock& block,
                                const std::vector<ScanPoints>& points, const Structure& start,
                                double scale);

}  // namespace tera
