#pragma once

#include <memory>
#include <vector>

#include "physics/dynamics/physics_world.h"
#include "sim/motion_source.h"
#include "sim/operators/operator.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// One operator for each machine.
using Operators = std::vector<std::unique_ptr<Operator>>;

/// The operators in a scenario, in their initial state.
Operators OperatorsOf(const Scenario& scenario);

/// Moves machines by operators and physics, together with dynamic obstacles.
///
/// Model   operators choose levers from the state of the machines and the ground at the start of a
///         step. While the machines settle, all levers are neutral. PhysicsWorld moves the bodies.
///         The run ends with InputError if all of a machine is metres below the ground.
class PhysicsMotion : public MotionSource {
 public:
  /// Keeps a reference to `scenario`.
  PhysicsMotion(const Scenario& scenario, Operators operators);
  PhysicsMotion(Scenario&&, Operators) = delete;

  void Start(const Begin& begin, WorldState* world) override;
  void Move(const Step& step, WorldState* world) override;
  bool IsKnown(std::size_t) const override { return true; }

 private:
  /// A dynamic obstacle: index in the scenario, and handle in the soil.
  struct Thing {
    std::size_t obstacle;
    int soil_handle;
  };

  std::vector<double> LeversOf(std::size_t machine, const WorldState& world);
  /// Adds the forces of the currently attached slings to the machines' inputs.
  void PullSlings(const WorldState& world, std::vector<MachineInput>* inputs) const;
  /// Copies the bodies of the physics and their contacts into `world`.
  void ReadBodies(WorldState* world) const;

  /// A side with the scenario's index; the physics counts things among its machines.
  BodyContact::Side OfScenario(BodyContact::Side side) const;
  void ReadContacts(WorldState* world) const;

  const Scenario& scenario_;
  Operators operators_;
  std::vector<Thing> things_;
  std::vector<std::size_t> guided_;  ///< obstacles that stand still or follow a path
  TimeNs start_ns_ = 0;
  std::unique_ptr<PhysicsWorld> physics_;
};

}  // namespace tera
