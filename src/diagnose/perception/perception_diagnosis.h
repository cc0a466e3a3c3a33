#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/perception/registration/registration_search.h"
#include "diagnose/perception/scene/ground_map.h"

namespace tera {

/// A finding from a lidar, depth camera or colour camera. Without a `place`, it is an error of the
/// sensor itself. With a `place`, the scene differs from the simulation there.
struct PerceptionFinding {
  /// Its errors are distances to the simulated surfaces or edges, on the held-out part FINAL.
  Finding finding;
  /// Site area of a finding in the scene: centre and bounding box.
  struct Place {
    Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  };
  std::optional<Place> place;
  std::vector<std::pair<double, double>> intervals_s;  ///< times of the difference; empty: always
};

/// Causes of the differences between one sensor's data and their simulation on the recorded
/// trajectory. The sensor is a lidar, a depth camera or a colour camera. Findings point into this
/// object's candidates, so the object can be moved but not copied.
struct PerceptionDiagnosis {
  PerceptionDiagnosis() = default;
  PerceptionDiagnosis(PerceptionDiagnosis&&) = default;
  PerceptionDiagnosis& operator=(PerceptionDiagnosis&&) = default;

  std::string channel;     ///< "excavator1/lidar_roof"
  std::string target;      ///< the sensor's name in the scenario
  std::string not_judged;  ///< reason; empty if judged
  std::string unit = "m";  ///< unit of residual distances; "px" for pictures
  std::size_t scans = 0;   ///< number of scans or pictures
  std::vector<Candidate> sensor_candidates;
  std::deque<Candidate> scene_candidates;  ///< candidates of the findings in the scene
  double noise_rmse = 0;                   ///< RMS residual after a fit of all sensor candidates
  /// Detectable deviations of the sensor candidates.
  std::vector<ParameterDetectability> detectability;
  GroundMap ground;  ///< compared under the fitted calibration; empty for pictures
  std::vector<PerceptionFinding> findings, unconfirmed;

  bool is_judged() const { return not_judged.empty(); }
  bool found_nothing() const { return findings.empty(); }
};

/// A diagnosis with the reason `why` the sensor cannot be judged.
inline PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                                     const std::string& why) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = channel;
  diagnosis.target = target;
  diagnosis.not_judged = why;
  return diagnosis;
}

/// Moves the noise, detectability and findings of a registration into the sensor's diagnosis.
inline void TakeOver(RegistrationSearch search, PerceptionDiagnosis* diagnosis) {
  diagnosis->noise_rmse = search.noise_rmse;
  diagnosis->detectability = std::move(search.detectability);
  for (Finding& found : search.findings) diagnosis->findings.push_back({std::move(found), {}, {}});
  for (Finding& found : search.unconfirmed) {
    diagnosis->unconfirmed.push_back({std::move(found), {}, {}});
  }
}

}  // namespace tera
