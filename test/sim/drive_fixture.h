#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "core/units.h"
#include "sim/simulation.h"

/// One machine, its drive and the ground together, as seen by an operator.

namespace tera {

/// Lever positions by name, the others neutral.
using NamedLevers = std::vector<std::pair<std::string, double>>;

/// Levers as a function of time, in seconds.
using LeverScript = std::function<NamedLevers(double)>;

/// Follows a script, which may be replaced during the run.
class ScriptedLevers : public Operator {
 public:
  explicit ScriptedLevers(std::shared_ptr<const LeverScript> script) : script_(std::move(script)) {}
  std::vector<double> Levers(const OperatorView& view) override {
    std::vector<double> levers(view.model.levers.size(), 0.0);
    for (const auto& [name, position] : (*script_)(ToSeconds(view.t_ns))) {
      levers.at(view.model.LeverIndex(name)) = position;
    }
    return levers;
  }

 private:
  std::shared_ptr<const LeverScript> script_;
};

/// One machine on a site of 30 m x 20 m; `terrain` and `more` are YAML. `machine` is a shipped
/// file's name or a path from the root.
struct Drive {
  Drive(const std::string& machine, const std::string& start, const std::string& terrain,
        double left, double right, const std::string& more = "")
      : scenario(Read(machine, start, terrain, more)) {
    Operate([=](double) { return NamedLevers{{"left_track", left}, {"right_track", right}}; });
    Operators operators;
    operators.push_back(std::make_unique<ScriptedLevers>(script));
    simulation = std::make_unique<Simulation>(scenario, std::move(operators));
  }

  /// From now on.
  void Operate(LeverScript levers) { *script = std::move(levers); }

  static Scenario Read(const std::string& machine, const std::string& start,
                       const std::string& terrain, const std::string& more) {
    const Config config =
        Config::FromText("name: drive\nduration_s: 60\nterrain: {size_m: [30, 20], " + terrain +
                             "}\nmachines:\n  - name: m\n    machine: " +
                             (machine.starts_with('/') ? "" : "tera:config/machines/") + machine +
                             "\n    start: " + start + "\n    operator: {type: idle}\n" + more,
                         "drive.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }

  void Run(
      double duration_s, const std::function<void()>& after_step = [] {}) {
    const TimeNs end_ns = simulation->state().t_ns + FromSeconds(duration_s);
    while (simulation->state().t_ns < end_ns) {
      simulation->Step();
      after_step();
    }
  }

  const MachineState& machine() const { return simulation->state().machines[0]; }
  const BodyState& body() const { return machine().links[0]; }
  Vec3 place() const { return body().X_WB.translation(); }
  double yaw_rad() const {
    const Mat3 R = body().X_WB.linear();
    return std::atan2(R(1, 0), R(0, 0));
  }
  /// Mean speed and yaw rate over `duration_s`.
  struct Motion {
    Vec3 v_W_mps;
    double yaw_rate_radps;
  };
  Motion Measure(double duration_s) {
    const Vec3 start = place();
    double yaw = yaw_rad(), turned = 0;
    Run(duration_s, [&] {
      turned += std::remainder(yaw_rad() - yaw, 2 * kPi);
      yaw = yaw_rad();
    });
    return {(place() - start) / duration_s, turned / duration_s};
  }
  Vec3 CentreOfMass() const {
    const MachineModel& model = scenario.machines[0].placement.model;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < model.links.size(); ++k) {
      sum += model.links[k].mass_kg * (machine().links[k].X_WB * model.links[k].com_B_m);
    }
    return sum / model.TotalMass_kg();
  }

  const Scenario scenario;
  const std::shared_ptr<LeverScript> script = std::make_shared<LeverScript>();
  std::unique_ptr<Simulation> simulation;
};

}  // namespace tera
