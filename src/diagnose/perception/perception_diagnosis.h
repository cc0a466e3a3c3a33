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

/// A finding of a ranging sensor or camera: of the sensor itself, everywhere and at all times, or
/// of the scene.
struct PerceptionFinding {
  /// Its errors are distances to the simulated surfaces or edges, on FINAL.
  Finding finding;
  /// Place on the site of a finding in the scene.
  struct Place {
    Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  };
  std::optional<Place> place;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Causes of the differences between one lidar's scans, or one camera's pictures, and their
/// simulation on the recorded trajectory. The findings point into its candidates, so it is moved,
/// never copied.
struct PerceptionDiagnosis {
  PerceptionDiagnosis() = default;
  PerceptionDiagnosis(PerceptionDiagnosis&&) = default;
  PerceptionDiagnosis& operator=(PerceptionDiagnosis&&) = default;

  std::string channel;     ///< "excavator1/lidar_roof"
  std::string target;      ///< the sensor's name in the scenario
  std::string not_judged;  ///< reason; empty if judged
  std::string unit = "m";  ///< of distances to the simulation; "px" for pictures
  std::size_t scans = 0;   ///< or pictures
  std::vector<Candidate> sensor_candidates;
  std::deque<Candidate> scene_candidates;  ///< candidates of the scene that were found
  double noise_rmse = 0;  ///< of the residual distances after a fit of all the sensor's candidates
  std::vector<ParameterDetectability> detectability;  ///< of the sensor's candidates
  GroundMap ground;  ///< under the fitted calibration; empty for pictures
  std::vector<PerceptionFinding> findings, unconfirmed;

  bool is_judged() const { return not_judged.empty(); }
  bool found_nothing() const { return findings.empty(); }
};

/// The diagnosis of a sensor that cannot be judged, for the reason `why`.
inline PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                                     const std::string& why) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = channel;
  diagnosis.target = target;
  diagnosis.not_judged = why;
  return diagnosis;
}

/// Moves a registration's noise, detectability and findings into the diagnosis of its sensor.
inline void TakeOver(RegistrationSearch search, PerceptionDiagnosis* diagnosis) {
  diagnosis->noise_rmse = search.noise_rmse;
  diagnosis->detectability = std::move(search.detectability);
  for (Finding& found : search.findings) diagnosis->findings.push_back({std::move(found), {}, {}});
  for (Finding& found : search.unconfirmed) {
    diagnosis->unconfirmed.push_back({std::move(found), {}, {}});
  }
}

}  // namespace tera
