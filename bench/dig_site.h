#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene_assembly.h"
#include "sim/simulation.h"

/// The quickstart's site, which all benchmarks use.

namespace tera::bench {

struct ShippedScenario {
  Scenario scenario;
  std::string resolved_yaml;
};

/// One of config/scenarios/, by name. `keep` selects among its machines' sensors.
ShippedScenario Load(const std::string& name,
                     const std::function<bool(const SensorDescription&)>& keep);
ShippedScenario Load(const std::string& name);
/// With some values set, as on the command line.
ShippedScenario LoadWith(const std::string& name, const std::vector<std::string>& overrides);

/// State of the site at one instant.
struct Instant {
  SceneState scene;  ///< its terrain is `ground`
  TerrainSurface ground;
  std::vector<Pose> X_WS;  ///< one for each sensor asked for
};

/// The quickstart with the bucket in the ground, at the instants of a 10 Hz camera.
class DigSite {
 public:
  DigSite();

  const SceneModel& model() const { return assembly_.model(); }
  const std::vector<SensorDescription>& sensors() const { return sensors_; }
  const std::vector<Instant>& instants() const { return instants_; }
  /// Index in sensors() and Instant::X_WS.
  std::size_t IndexOf(const std::string& sensor) const;

 private:
  void Remember(const Simulation& simulation);

  Scenario scenario_;
  SceneAssembly assembly_;
  std::vector<SensorDescription> sensors_;  ///< of all machines
  std::vector<std::size_t> machine_of_sensor_;
  std::vector<Instant> instants_;
};

/// Created on first use.
const DigSite& TheDigSite();

}  // namespace tera::bench
