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

/// The operators that a scenario gives its machines, in their initial state.
Operators OperatorsOf(const Scenario& scenario);

/// Machines that obey operators and move by physics, together with dynamic obstacles.
///
/// Model   operators give levers from the machines and the ground at a step's start; all levers are
///         neutral while the machines settle. PhysicsWorld moves the bodies. A machine that is
///         wholly metres below the ground ends the run with InputError.
class PhysicsMotion : public MotionSource {
 public:
  /// Keeps a reference to `scenario`.
  PhysicsMotion(const Scenario& scenario, Operators operators);
  PhysicsMotion(Scenario&&, Operators) = delete;

  void Start(const Begin& begin, WorldState* world) override;
  void Move(const Step& step, WorldState* world) override;
  bool IsKnown(std::size_t) const override { return true; }

 private:
  /// Dynamic obstacle: its index in the scenario, and its handle in the soil.
  struct Thing {
    std::size_t obstacle;
    int soil_handle;
  };

  std::vector<double> LeversOf(std::size_t machine, const WorldState& world);
  /// Adds the forces of the slings that are attached now.
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
