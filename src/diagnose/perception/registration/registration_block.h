#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "diagnose/blocks/candidate_list.h"
#include "diagnose/perception/registration/point_residual.h"

namespace tera {

/// One sensor's recording and simulation, as input to the search for effects on the sensor. It
/// corresponds to ReplayBlock (search/fit/replay_block.h) of channels on one grid. Points are
/// associated anew with simulated surfaces or edges whenever the sensor moves. The number of judged
/// points and their associations therefore depend on the terms, and each point has its own noise.
///
/// Frames  B link, S sensor as documented.
struct RegistrationBlock {
  Pose X_BS = Pose::Identity();
  Effects present;                    ///< of the sensor, as the scenario has them
  std::vector<Candidate> candidates;  ///< possible effects on it
  /// Residuals of points under a calibration. Level 0 has full resolution. Each further level, up
  /// to `coarsest`, covers twice the distance with less detail.
  std::function<std::vector<PointResidual>(const std::vector<ScanPoints>& points,
                                           const SensorCalibration& calibration, int level)>
      residuals;
  int coarsest = 0;

  /// The calibration in which each term replaces the scenario's effect of its mechanism.
  SensorCalibration Under(const Structure& terms) const {
    return CalibrationUnder(X_BS, WithTerms(present, terms));
  }
};

}  // namespace tera
