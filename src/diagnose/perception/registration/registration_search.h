#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// Points of a recording by part, with the time block of each scan.
struct SplitPoints {
  std::vector<ScanPoints> train, select, seen, final;  ///< seen: TRAIN and SELECT
  std::vector<std::size_t> block;                      ///< of time, of each scan
};

/// `points` gives those of the scans of some parts.
SplitPoints PointsOfParts(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points);

/// Smallest detectable value of a candidate's parameter.
struct ParameterDetectability {
  const Candidate* candidate = nullptr;
  std::size_t parameter = 0;       ///< of its mechanism
  std::optional<double> smallest;  ///< none: undetectable
};

/// Result of the search for effects on a sensor.
struct RegistrationSearch {
  Structure found;                ///< confirmed, with its values
  SensorCalibration calibration;  ///< with all findings
  double scale = 1;               ///< of the noise, over its model
  double noise_rmse = 0;          ///< of the residual distances after a fit of all candidates
  /// Each finding has its evidence, and its error on FINAL without it and with it. It acts
  /// everywhere and at all times, so it has no location. Findings point into the block's
  /// candidates.
  std::vector<Finding> findings, unconfirmed;
  std::vector<ParameterDetectability> detectability;
};

/// Share of the excess error that a finding removes. The excess is the mean square error without it
/// minus that of the noise. 0 without excess.
double ExcessRemoved(const HeldOutError& error, double noise_rmse);

/// Selects the block's candidates that act on its sensor, starting at the values of `start`.
///
/// Model   noise from the residual of a fit of all candidates to TRAIN. Forward selection from
///         nothing takes the structure with the greatest gain on SELECT first. Each structure is
///         fitted to TRAIN (registration_fit.h). A term stays if its gain there is steady over
///         blocks of time (steady_gain.h; SearchOptions::alpha, Bonferroni over the candidates) and
///         reduces the error by at least 2 %. Superfluous terms beside the others are then removed.
///         A candidate with fewer parameters is preferred if it is not steadily worse. A candidate
///         that is equally good in a term's place is its rival. On FINAL, unused by any fit, each
///         must gain steadily again (kConfirmedP).
/// Omits   cross-fitting, pairs of candidates that show only together, and a flexible regressor,
///         which StructureSearch has for channels. At most four candidates act on a sensor, and
///         thousands of points distinguish them.
RegistrationSearch SearchRegistration(const RegistrationBlock& block, const SplitPoints& points,
                                      const Structure& start = {});

}  // namespace tera
