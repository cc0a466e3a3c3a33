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

/// Evolves a world that starts from a scenario: soil forces -> motion of the bodies -> flow of the
/// soil. All changing state lives here; any number of simulations may share one scenario.
///
/// Frames  W; links and joints as in MachineState.
/// Model   fixed step 1 / physics_rate_hz; time is the start plus the step count over the rate.
///         Bodies move by physics, or by a MotionSource; dynamic obstacles move by physics alone.
///         The machines settle on the ground for `settle_s` until the start. Soil and bodies are
///         coupled explicitly: ground forces follow from the motion at the step's start.
/// Omits   contact of several machines with the same soil: each acts on the ground in turn.
class Simulation {
 public:
  /// Machines driven by the scenario's operators, from t = 0 on. Keeps a reference to `scenario`;
  /// runs the settling.
  explicit Simulation(const Scenario& scenario);
  explicit Simulation(Scenario&&) = delete;  ///< a temporary would not outlive the simulation
  /// Machines driven by other operators.
  Simulation(const Scenario& scenario, Operators operators);
  Simulation(Scenario&&, Operators) = delete;
  /// Machines moved by `motion`, from `start_ns` on.
  Simulation(const Scenario& scenario, std::unique_ptr<MotionSource> motion, TimeNs start_ns = 0);
  Simulation(Scenario&&, std::unique_ptr<MotionSource>, TimeNs = 0) = delete;

  void Step();

  const WorldState& state() const { return state_; }
  /// At the start of the last step.
  const Instant& previous() const { return previous_; }
  const TerrainSurface& ground() const { return state_.ground().surface(); }
  WorldStep last_step() const { return {previous_, state_, ground()}; }

  /// Wall-clock seconds since the start, for reports only.
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
  std::vector<int> obstacle_handle_;            ///< handle in the soil, one for each obstacle
  WorldState state_;
  Instant previous_;
  double physics_wall_s_ = 0, soil_wall_s_ = 0;
};

}  // namespace tera
