#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/time.h"
#include "physics/dynamics/physics_world.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// Everything that moves, at one instant, but for the ground (see Simulation::ground).
struct WorldState {
  TimeNs t_ns = 0;
  std::vector<MachineState> machines;
  std::vector<BodyState> obstacles;
  std::vector<BedLoad> beds;  ///< one for each obstacle; nothing where it has no bed
};

/// Evolves a scenario: levers -> soil's forces -> bodies -> flow of the soil.
///
/// Frames  W; links and joints as in MachineState.
/// Model   fixed step 1 / physics_rate_hz; time is the step count over the rate. Before t = 0 the
///         machines settle on the ground for `settle_s` with neutral levers. Soil and bodies are
///         coupled explicitly: forces of the ground follow from the motion at the step's start.
/// Omits   soil between machines at the same place at once: each acts on the ground in turn.
class Simulation {
 public:
  /// Keeps a reference to `scenario`, whose soil and operators it changes; runs the settling.
  explicit Simulation(Scenario* scenario);

  void Step();

  const WorldState& state() const { return state_; }
  const WorldState& previous() const { return previous_; }
  const TerrainSurface& ground() const { return scenario_->soil->surface(); }

  /// Wall-clock seconds spent since the start, for reports alone.
  double physics_wall_s() const { return physics_wall_s_; }
  double soil_wall_s() const { return soil_wall_s_; }

 private:
  std::vector<double> LeversOf(std::size_t machine) const;
  SoilReaction GroundActsOn(std::size_t machine);
  void MoveObstacles();
  void Capture();

  Scenario* scenario_;
  SampleClock clock_;
  std::int64_t step_;
  std::unique_ptr<PhysicsWorld> physics_;
  std::vector<int> soil_handle_;                ///< one for each machine
  std::vector<std::optional<int>> bed_handle_;  ///< one for each obstacle
  std::vector<int> obstacle_handle_;            ///< the soil's, one for each
  WorldState state_, previous_;
  double physics_wall_s_ = 0, soil_wall_s_ = 0;
};

}  // namespace tera
