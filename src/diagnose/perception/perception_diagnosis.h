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

/// A finding of a sensor that measures ranges or takes pictures: of the sensor itself, everywhere
/// and all the time, or of the scene.
struct PerceptionFinding {
  /// Its errors are distances to the simulated surfaces or edges, on FINAL.
  Finding finding;
  /// Where on the site a finding of the scene lies.
  struct Place {
    Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  };
  std::optional<Place> place;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Why the scans of one lidar, or the pictures of one camera, differ from the simulation of the
/// same on the recorded trajectory. The findings point into its candidates: it is moved, not
/// copied.
struct PerceptionDiagnosis {
  PerceptionDiagnosis() = default;
  PerceptionDiagnosis(PerceptionDiagnosis&&) = default;
  PerceptionDiagnosis& operator=(PerceptionDiagnosis&&) = default;

  std::string channel;     ///< "excavator1/lidar_roof"
  std::string target;      ///< the sensor's name in the scenario
  std::string not_judged;  ///< why; empty where it is judged
  std::string unit = "m";  ///< of distances to what is simulated; of pictures "px"
  std::size_t scans = 0;   ///< or pictures
  std::vector<Candidate> sensor_candidates;
  std::deque<Candidate> scene_candidates;  ///< those that were found
  double noise_rmse = 0;  ///< of the distances that a fit of all candidates of the sensor leaves
  std::vector<ParameterDetectability> detectability;  ///< of the sensor's candidates
  GroundMap ground;  ///< under the calibration that was found; none of pictures
  std::vector<PerceptionFinding> findings, unconfirmed;

  bool is_judged() const { return not_judged.empty(); }
  bool found_nothing() const { return findings.empty(); }
};

/// The diagnosis of a sensor of which nothing can be said, for the reason `why`.
PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                              const std::string& why);

/// Moves a registration's noise, detectability and findings into the diagnosis of its sensor.
void TakeOver(RegistrationSearch search, PerceptionDiagnosis* diagnosis);

}  // namespace tera
