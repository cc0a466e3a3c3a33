#pragma once

#include <vector>

#include "soil/columns/bed.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"

namespace tera {

/// The flow of the soil that lies in a truck's bed.
///
/// Model   Soil flows on the bed's columns as on the ground. What stands above the walls' rim at
///         the border falls off beside the bed as clods.
class BedFlow {
 public:
  explicit BedFlow(const std::vector<SoilType>& soils) : avalanche_(soils) {}

  /// Lets time pass; what overflows is poured beside the bed.
  void Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains);

 private:
  Avalanche avalanche_;
};

}  // namespace tera
