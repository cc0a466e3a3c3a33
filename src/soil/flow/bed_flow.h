#pragma once

#include <vector>

#include "soil/columns/bed.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/grains.h"

namespace tera {

/// The flow of the soil that lies in a truck's bed.
///
/// Model   Soil flows on the bed's columns as on the ground, on a floor of steel that stands as the
///         carrier does. Soil at the border falls off beside the bed as clods where it stands above
///         the slope at repose. The slope starts at the walls' rim, or at the lip of an open gate.
///         Where the floor is too steep to hold soil, all soil that reaches an open gate falls off.
/// Omits   the carrier's acceleration; adhesion to the floor; friction on the side walls.
class BedFlow {
 public:
  explicit BedFlow(const std::vector<SoilType>& soils) : avalanche_(soils) {}

  /// Lets time pass; overflowing soil is poured beside the bed.
  void Flow(double dt_s, Bed* bed, Columns* ground, Grains* grains);

 private:
  void Stand(Bed* bed);
  void Overflow(int i, int j, Bed* bed, Columns* ground, Grains* grains) const;

  Avalanche avalanche_;
  Vec3 up_F_ = Vec3::UnitZ();  ///< as the soil was last told
  bool is_open_ = false;       ///< the gate, at the lower end
};

}  // namespace tera
