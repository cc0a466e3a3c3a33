#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine.h"

namespace tera {

/// An operator's view: the machine's state and the ground.
struct OperatorView {
  TimeNs t_ns = 0;
  const MachineModel& model;
  const MachineState& state;
  const TerrainSurface& ground;
};

/// A source of lever positions.
class Operator {
 public:
  virtual ~Operator() = default;
  /// Levers in [-1, 1], one for each lever of the model, held until the next call. Called once per
  /// physics step in increasing time.
  virtual std::vector<double> Levers(const OperatorView& view) = 0;
};

/// Random stream of an operator.
struct OperatorStream {
  std::uint64_t seed = 0;
  std::string machine;
};

}  // namespace tera
