#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine.h"

namespace tera {

/// The information that an operator has: the state of the machine, and the ground.
struct OperatorView {
  TimeNs t_ns = 0;
  const MachineModel& model;
  const MachineState& state;
  const TerrainSurface& ground;
};

/// Operates a machine by levers.
class Operator {
 public:
  virtual ~Operator() = default;
  /// Lever positions in [-1, 1], one for each lever of the model. They hold until the next call.
  /// Called once per physics step, with increasing time.
  virtual std::vector<double> Levers(const OperatorView& view) = 0;
};

/// Identifies the random stream of a machine's operator.
struct OperatorStream {
  std::uint64_t seed = 0;
  std::string machine;
};

}  // namespace tera
