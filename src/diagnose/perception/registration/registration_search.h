#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Points of a recording, grouped by part.
struct SplitPoints {
  std::vector<ScanPoints> train, select, seen, final;  ///< seen: TRAIN and SELECT
  std::vector<std::size_t> block;                      ///< block of time of each scan
};

/// `points` returns the points of all scans in the given parts.
SplitPoints PointsOfParts(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points);

/// Smallest detectable deviation of one parameter of a candidate.
struct ParameterDetectability {
  const Candidate* candidate = nullptr;
  std::size_t parameter = 0;       ///< index in the candidate's mechanism
  std::optional<double> smallest;  ///< none: undetectable
};

/// Result of the search for effects on a sensor.
struct RegistrationSearch {
  Structure found;                ///< confirmed terms
  SensorCalibration calibration;  ///< calibration with the confirmed terms
  double scale = 1;               ///< actual noise over modelled noise
  double noise_rmse = 0;          ///< RMS residual after a fit of all candidates
  /// Findings have evidence, and errors on FINAL without and with the finding. Findings have no
  /// location, because a sensor's effects act at all times. Findings point into the block's
  /// candidates.
  std::vector<Finding> findings, unconfirmed;
  std::vector<ParameterDetectability> detectability;
};

/// Share of the excess error that a finding removes. The excess is the mean square error without
/// the finding minus the mean square noise. Returns 0 without excess.
double ExcessRemoved(const HeldOutError& error, double noise_rmse);

/// Selects the candidate mechanisms that act on the block's sensor. Fits start at the values of
/// `start`, or else at the scenario's values.
///
/// Model   The noise is estimated from the residual after a fit of all candidates to TRAIN.
///         Selection is forward, starting from no candidate. Nothing is selected unless all
///         candidates together are better than none. Each step adds the candidate with the greatest
///         gain in likelihood on SELECT, after a fit to TRAIN (registration_fit.h). If a set with
///         fewer parameters is not significantly worse, it is preferred.
///         A step is accepted if the gain is steady over blocks of time (steady_gain.h) and the
///         error falls by at least 2 %. The level is SearchOptions::alpha, Bonferroni-corrected
///         over the candidates. Terms that the other terms make superfluous are then removed. A
///         rival of a term is another candidate that is not significantly worse in its place. Each
///         term must gain steadily again on FINAL, which no fit uses (kConfirmedP).
/// Omits   Cross-fitting, pairs of candidates that are visible only together, and a flexible
///         regressor. StructureSearch has these for channels. A sensor has at most four candidates,
///         and thousands of points distinguish them.
RegistrationSearch SearchRegistration(const RegistrationBlock& block, const SplitPoints& points,
                                      const Structure& start = {});

}  // namespace tera
