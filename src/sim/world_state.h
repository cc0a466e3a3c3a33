#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "physics/description/machine.h"
#include "physics/dynamics/body_contact.h"
#include "soil/soil.h"

namespace tera {

/// All moving bodies at one instant, without the ground. Cheap to copy.
struct Instant {
  TimeNs t_ns = 0;
  std::vector<MachineState> machines;
  std::vector<BodyState> obstacles;
  std::vector<BedLoad> beds;  ///< one for each obstacle; nothing without a bed
  /// Contacts of machines in the last step, with indices of the scenario; `a` is a machine. Two
  /// machines have one for each. Only physics knows them, not recordings.
  std::vector<BodyContact> contacts;
};

/// One step of a world as sensors see it: bodies at both ends, the ground at the end.
struct WorldStep {
  const Instant& before;
  const Instant& after;
  const TerrainSurface& ground;
};

/// The current world: the moving bodies and the ground. The ground is not copied.
class WorldState : public Instant {
 public:
  explicit WorldState(std::unique_ptr<Soil> ground) : ground_(std::move(ground)) {}

  const Soil& ground() const { return *ground_; }
  Soil& ground() { return *ground_; }

 private:
  std::unique_ptr<Soil> ground_;
};

}  // namespace tera
