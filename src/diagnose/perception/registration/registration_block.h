#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/perception/registration/point_residual.h"

namespace tera {

/// One sensor's recording beside its simulation, as a search for what acts on the sensor works on
/// it: what ReplayBlock (search/fit/replay_block.h) is to channels of one grid, for points that are
/// associated with simulated surfaces or edges anew wherever the sensor is moved. How many points
/// are judged, and against what, then depends on the terms, and each has a noise of its own.
///
/// Frames  B link, S sensor as documented.
struct RegistrationBlock {
  Pose X_BS = Pose::Identity();
  Effects present;                    ///< of the sensor, as the scenario has them
  std::vector<Candidate> candidates;  ///< what may act on it
  /// Residuals of points under a calibration. Level 0 is in full; each further one, up to
  /// `coarsest`, sees differences twice as large, but less of them.
  std::function<std::vector<PointResidual>(const std::vector<ScanPoints>& points,
                                           const SensorCalibration& calibration, int level)>
      residuals;
  int coarsest = 0;

  /// The calibration in which each term takes the place of what the scenario has of its mechanism.
  SensorCalibration Under(const Structure& terms) const {
    return CalibrationUnder(X_BS, WithTerms(present, terms));
  }
};

}  // namespace tera
