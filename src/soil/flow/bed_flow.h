#pragma once

#include <vector>

#include "soil/columns/bed.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"

namespace tera {

/// Flow of the soil in the bed of a truck.
///
/// Model   Soil flows on the columns of the bed as on the ground, over a steel floor with the tilt
///         of the carrier. At the border, soil above the slope at repose falls off as clods beside
///         the bed. That slope starts at the rim of the walls, or at the lip of an open gate. On a
///         floor too steep to hold soil, all soil at an open gate falls off.
/// Omits   Acceleration of the carrier, adhesion to the floor, friction on the side walls.
class BedFlow {
 public:
  explicit BedFlow(const std::vector<SoilType>& soils) : avalanche_(soils) {}

  /// Advances time. Overflowing soil is poured beside the bed.
  void Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains);

 private:
  void Stand(Bed* bed);
  void Overflow(int i, int j, Bed* bed, Columns* ground, Grains* grains) const;

  Avalanche avalanche_;
  Vec3 up_F_ = Vec3::UnitZ();  ///< orientation last passed to the avalanche
  bool is_open_ = false;       ///< the gate is open and at the lower end
};

}  // namespace tera
