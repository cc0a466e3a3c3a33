#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "own_folder.h"
#include "sim/run/live_run.h"

/// A remotely driven compact excavator. It stands on asphalt, rotated and off the origin.

namespace tera {

inline constexpr const char* kRemoteScenario = R"(
name: remote
duration_s: 60
settle_s: 1
terrain: {size_m: [20, 20], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, -2], yaw_deg: 30}
    operator: {type: idle}
)";

/// With the files of `overlays`, relative to the data root, as effects.
inline Scenario RemoteScenario(const std::vector<std::string>& overlays = {}) {
  const std::filesystem::path file = OwnFolder() / "remote.yaml";
  std::ofstream(file) << kRemoteScenario;
  std::vector<Config::Overlay> effects;
  for (const std::string& overlay : overlays) effects.push_back({DataRoot() / overlay, "effects"});
  const Config config = Config::FromFile(file, {}, effects);
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

class RemoteMachineTest : public testing::Test {
 protected:
  explicit RemoteMachineTest(const std::vector<std::string>& overlays = {})
      : run_(std::make_shared<const Scenario>(RemoteScenario(overlays)), "", {}, {}) {}

  const MachineModel& model() const { return run_.scenario().machines[0].placement.model; }
  const MachineState& state() const { return run_.simulation().state().machines[0]; }
  double Angle(const char* joint) const { return state().q_rad[model().JointIndex(joint)]; }

  /// Sends the message at 10 Hz, as a controller does.
  void Drive(const ControlMessage& message, double duration_s) {
    ASSERT_EQ(FaultOf(message, model()), std::nullopt);
    for (int step = 0; step < duration_s * 500; ++step) {
      if (step % 50 == 0) run_.Command(0, message);
      run_.Step();
    }
  }

  /// Values for each lever, by name; others `otherwise`.
  std::vector<double> ByLever(const std::vector<std::pair<std::string, double>>& values) const {
    std::vector<double> all(model().levers.size(), 0.0);
    for (const auto& [name, value] : values) all[model().LeverIndex(name)] = value;
    return all;
  }

  Vec3 TipInRoot() const {
    const NamedFrame& tip = model().frames[0];
    return state().links[0].X_WB.inverse() *
           (state().links[tip.link].X_WB * tip.X_BF.translation());
  }

  LiveRun run_;
};

}  // namespace tera
