#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "core/types/terrain_surface.h"
#include "physics/description/machine.h"

namespace tera {

/// What an operator sees: the machine's own state and the ground before it.
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
  /// Levers in [-1, 1], one for each lever of the model, to be held until the next call. Called
  /// once for each physics step, times increasing.
  virtual std::vector<double> Levers(const OperatorView& view) = 0;
};

/// Where an operator's random numbers come from.
struct OperatorStream {
  std::uint64_t seed = 0;
  std::string machine;
};

}  // namespace tera
