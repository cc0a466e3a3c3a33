#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/faults.h"
#include "core/units.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/dynamics/physics_world.h"

/// Small machines for the physics tests, and a world that steps one of them.

namespace tera {

inline constexpr double kGravity_mps2 = 9.81;
inline constexpr double kStep_s = 0.002;

inline MachineModel MachineFromText(const std::string& yaml,
                                    const std::vector<std::string>& overrides = {}) {
  const Config config = Config::FromText(yaml, "test.yaml", overrides);
  MachineModel model = ReadMachine(config.root());
  config.Finish();
  return model;
}

inline MachineModel ShippedMachine(const std::string& name,
                                   const std::vector<std::string>& overrides = {}) {
  const Config config =
      Config::FromFile(DataRoot() / "config/machines" / (name + ".yaml"), overrides);
  MachineModel model = ReadMachine(config.root());
  config.Finish();
  return model;
}

/// `model` with the effects of `yaml`, a mapping of its joints, gears and pumps.
inline MachineModel WithEffects(MachineModel model, const std::string& yaml) {
  const Config config = Config::FromText(yaml, "effects.yaml");
  const auto read = [&](const std::string& name, EffectTarget target) {
    const auto map = config.root().OptionalMap(name);
    return map ? ReadEffects(*map, target, ActuationMechanisms()) : Effects{};
  };
  model.effects = {};
  for (const Joint& joint : model.joints) {
    model.effects.joints.push_back(read(joint.name, EffectTarget::kJoint));
  }
  for (const RunningGear& gear : model.ground_tools.gears) {
    model.effects.gears.push_back(read(gear.name, EffectTarget::kGear));
  }
  for (const Pump& pump : model.pumps) {
    model.effects.pumps.push_back(read(pump.name, EffectTarget::kPump));
  }
  config.Finish();
  return model;
}

/// All faults of a description; empty if it has none.
inline std::vector<InputFault> FaultsOf(const std::string& yaml,
                                        const std::vector<std::string>& overrides = {}) {
  return FaultsIn([&] { MachineFromText(yaml, overrides); });
}

/// An arm of 20 kg and 1.5 m on a fixed post, its centre of mass 0.8 m from the pin, carrying a
/// shovel at its end. It turns about -y: positive angles raise it.
inline const std::string kLiftArm = R"(
kind: lift_arm
fixed_base: true
links:
  post: {mass_kg: 50, inertia_kgm2: [1, 1, 1]}
  arm: {mass_kg: 20, com_m: [0.8, 0, 0], inertia_kgm2: [0.2, 3.0, 3.1]}
joints:
  lift:
    type: revolute
    parent: post
    child: arm
    xyz_m: [0.3, 0, 1.2]
    axis: [0, -1, 0]
    limits_deg: [-170, 170]
    max_rate_degps: [30, 20]
    max_effort_nm: 2000
levers: [lift]
shovels:
  scoop: {link: arm, profile_m: [[1.8, 0], [1.6, -0.2], [1.4, 0]], width_m: 0.5, capacity_m3: 0.05}
)";

/// A bar of 4 kg, 1.2 m long, hanging from a pin at one end, without a motor.
inline const std::string kPendulum = R"(
kind: pendulum
fixed_base: true
links:
  post: {mass_kg: 1, inertia_kgm2: [1, 1, 1]}
  bar: {mass_kg: 4, com_m: [0, 0, -0.6], inertia_kgm2: [0.48, 0.48, 0.01]}
joints:
  pin: {type: continuous, parent: post, child: bar, xyz_m: [0.1, 0.2, 2], axis: [0, 1, 0]}
)";

inline MachinePlacement PlaceAtStart(const MachineModel& model, const Pose& X_WB,
                                     const std::string& name = "machine") {
  MachinePlacement placement{.name = name, .model = model, .X_WB = X_WB};
  for (const Joint& joint : model.joints) placement.q_rad.push_back(joint.initial_rad);
  return placement;
}

/// One machine alone in the air.
class MachineRun {
 public:
  explicit MachineRun(const MachineModel& model, const Pose& X_WB = Pose::Identity(),
                      double gravity_mps2 = kGravity_mps2)
      : MachineRun(PlaceAtStart(model, X_WB), gravity_mps2) {}
  explicit MachineRun(const MachinePlacement& placement, double gravity_mps2 = kGravity_mps2)
      : world_({placement}, {}, gravity_mps2) {
    input.levers.assign(placement.model.levers.size(), 0.0);
    input.soil.link_wrench.resize(placement.model.links.size());
  }

  void Step(int count = 1) {
    for (int i = 0; i < count; ++i) world_.Step({input}, {}, kStep_s);
  }
  void StepFor(double duration_s) { Step(static_cast<int>(std::lround(duration_s / kStep_s))); }
  const MachineState& state() const { return world_.machines()[0]; }

  MachineInput input;

 private:
  PhysicsWorld world_;
};

/// Kinetic and potential energy of a machine between its states `a` and, a step later, `b`.
inline double Energy_j(const MachineModel& model, const MachineState& a, const MachineState& b) {
  double energy_j = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    // The scheme's velocities belong to the middle of steps; at `a` the mean of both sides applies.
    const Vec3 v =
        0.5 * (PointVelocity(a.links[i], link.com_B_m) + PointVelocity(b.links[i], link.com_B_m));
    const Vec3 w_W = 0.5 * (a.links[i].w_WB_radps + b.links[i].w_WB_radps);
    const Vec3 w_B = a.links[i].X_WB.linear().transpose() * w_W;
    energy_j += 0.5 * link.mass_kg * v.squaredNorm() + 0.5 * w_B.dot(link.inertia_B_kgm2 * w_B) +
                link.mass_kg * kGravity_mps2 * (a.links[i].X_WB * link.com_B_m).z();
  }
  return energy_j;
}

}  // namespace tera
