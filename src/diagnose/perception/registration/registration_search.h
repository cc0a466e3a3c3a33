#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/registration/scan_split.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// The points of a recording by what they may be used for, and when they were measured.
struct SplitPoints {
  std::vector<ScanPoints> train, select, seen, final;  ///< seen: TRAIN and SELECT
  std::vector<std::size_t> block;                      ///< of time, of each scan
};

/// `points` gives those of the scans of some parts.
SplitPoints PointsOfParts(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points);

/// How small a parameter of a candidate may be and still change the distances enough.
struct ParameterDetectability {
  const Candidate* candidate = nullptr;
  std::size_t parameter = 0;       ///< of its mechanism
  std::optional<double> smallest;  ///< none: the points do not tell
};

/// What acts on a sensor.
struct RegistrationSearch {
  Structure found;                ///< confirmed, with its values
  SensorCalibration calibration;  ///< under what was found
  double scale = 1;               ///< of the noise over its model
  double noise_rmse = 0;          ///< of the distances that a fit of all candidates leaves
  /// Each finding has its evidence, and its error on FINAL without it and with it. It acts
  /// everywhere and all the time, so that nothing is located. Findings point into the block's
  /// candidates.
  std::vector<Finding> findings, unconfirmed;
  std::vector<ParameterDetectability> detectability;
};

/// Share that a finding removes of the excess: the mean square error without it, less that of the
/// noise. 0 where there is no such excess.
double ExcessRemoved(const HeldOutError& error, double noise_rmse);

/// Which of a block's candidates act on its sensor, beginning at the values of `start`.
///
/// Model   noise from what a fit of all candidates leaves of TRAIN. Forward from nothing, each
///         structure fitted to TRAIN (registration_fit.h), the one that gains most on SELECT first;
///         a term stays if its gain there is steady over blocks of time (steady_gain.h;
///         SearchOptions::alpha, Bonferroni over the candidates) and makes the error at least 2 %
///         smaller; then each that the others can do without goes. A candidate of fewer parameters
///         is preferred where it is not steadily worse, and what does as well in a term's place is
///         its rival. On FINAL, which nothing was fitted to, each must gain steadily again
///         (kConfirmedP).
/// Omits   cross-fitting, pairs of candidates that show beside each other alone, and a flexible
///         regressor, as StructureSearch has them for channels: four candidates at most act on a
///         sensor, which thousands of points tell apart.
RegistrationSearch SearchRegistration(const RegistrationBlock& block, const SplitPoints& points,
                                      const Structure& start = {});

}  // namespace tera
