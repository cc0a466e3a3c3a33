#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "diagnose/perception/scans/dust.h"
#include "diagnose/perception/scans/ground_map.h"
#include "diagnose/perception/scans/missing_objects.h"
#include "diagnose/perception/scans/range_scan.h"
#include "diagnose/perception/scans/sensor_search.h"

namespace tera {

/// What makes scans differ, as the report tells it.
struct PerceptionFinding {
  std::string mechanism;                      ///< "extrinsic", "terrain_height"
  std::string slot;                           ///< as of Mechanism
  std::string target;                         ///< a sensor, an obstacle, or "ground"
  bool is_effect = false;                     ///< effects.yaml knows it on this target
  std::vector<ParameterEstimate> parameters;  ///< in the units of effects.yaml
  std::vector<double> present;                ///< of each, as the scenario has it; may be empty
  std::vector<std::string> rivals;            ///< that do as well, itself first
  double p_chosen = 1, p_confirmed = 1;
  /// Of distances to the simulated surfaces or edges, on FINAL: without it, with it.
  double rmse_before = 0, rmse_after = 0;
  /// Where on the site, if it is a place.
  struct Place {
    Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  };
  std::optional<Place> place;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Why the scans of one lidar, or the pictures of one camera, differ from the simulation of the
/// same on the recorded trajectory.
struct PerceptionDiagnosis {
  std::string channel;     ///< "excavator1/lidar_roof"
  std::string target;      ///< the sensor's name in the scenario
  std::string not_judged;  ///< why; empty where it is judged
  std::string unit = "m";  ///< of what `sensor` and the findings differ by; of pictures "px"
  std::size_t scans = 0;   ///< or pictures
  SensorSearch sensor;
  GroundMap ground;  ///< under the numbers that were found; none of pictures
  std::vector<PerceptionFinding> findings, unconfirmed;

  bool is_judged() const { return not_judged.empty(); }
  bool found_nothing() const { return findings.empty(); }
};

/// Of a sensor of which nothing can be said.
PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                              const std::string& why);

/// As the report tells it.
PerceptionFinding AsFinding(const SensorFinding& found, const std::string& target);

/// Numbers of the sensor first, then places (docs/perception.md).
PerceptionDiagnosis DiagnosePerception(const RangeSource& source, std::uint64_t seed);

}  // namespace tera
