#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/time.h"
#include "sim/motion_source.h"
#include "sim/physics_motion.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Simulates a scenario. Each step: soil forces, motion of the bodies, flow of the soil. This
/// object holds all changing state, so several simulations may share one scenario.
///
/// Frames  W; links and joints as in MachineState.
/// Model   fixed step of 1 / physics_rate_hz. Bodies move by physics, or machines follow a
///         MotionSource; dynamic obstacles always move by physics. Before the start the machines
///         settle on the ground for `settle_s`. Soil and bodies are coupled explicitly: ground
///         forces follow from the motion at the start of the step.
/// Omits   simultaneous contact of several machines with the same soil: they act on the ground one
///         after the other.
class Simulation {
 public:
  /// Machines driven by the scenario's operators, from t = 0. Keeps a reference to `scenario`. Runs
  /// the settling.
  explicit Simulation(const Scenario& scenario);
  /// A temporary would be destroyed before the simulation.
  explicit Simulation(Scenario&&) = delete;
  /// Machines driven by the given operators.
  Simulation(const Scenario& scenario, Operators operators);
  Simulation(Scenario&&, Operators) = delete;
  /// Machines moved by `motion`, from `start_ns` on.
  Simulation(const Scenario& scenario, std::unique_ptr<MotionSource> motion, TimeNs start_ns = 0);
  Simulation(Scenario&&, std::unique_ptr<MotionSource>, TimeNs = 0) = delete;

  void Step();

  const WorldState& state() const { return state_; }
  /// The state at the start of the last step.
  const Instant& previous() const { return previous_; }
  const TerrainSurface& ground() const { return state_.ground().surface(); }
  WorldStep last_step() const { return {previous_, state_, ground()}; }

  /// Wall-clock time since the start, for reports only.
  double physics_wall_s() const { return physics_wall_s_; }
  double soil_wall_s() const { return soil_wall_s_; }

 private:
  std::vector<SoilReaction> GroundActs();
  void MoveAlongPaths(TimeNs t_ns);
  void ShowObstaclesToSoil(TimeNs t_ns);
  void Count();

  const Scenario& scenario_;
  SampleClock clock_;
  std::int64_t step_;
  std::unique_ptr<MotionSource> motion_;
  std::vector<int> soil_handle_;                ///< one for each machine
  std::vector<std::optional<int>> bed_handle_;  ///< one for each obstacle
  std::vector<int> obstacle_handle_;            ///< handle in the soil, one per obstacle
  WorldState state_;
  Instant previous_;
  double physics_wall_s_ = 0, soil_wall_s_ = 0;
};

}  // namespace tera
