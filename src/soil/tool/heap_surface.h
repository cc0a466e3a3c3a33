#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "soil/tool/heap_grid.h"
#include "soil/tool/shovel_shape.h"

namespace tera {

/// Soil in a shovel.
struct CarriedHeap {
  double volume_m3 = 0;
  Vec3 up_B = Vec3::UnitZ();          ///< against gravity
  Vec3 surface_up_B = Vec3::UnitZ();  ///< normal of the plane of the surface
  double repose_rad = 0;
};

/// The surface of the soil in a shovel, as triangles.
///
/// Frames  B frame of the shovel's link.
/// Model   The heap of HeapGrid that encloses the carried volume. The shovel may carry more than
///         stays at the angle of repose, because soil takes time to leave or sticks. The heap then
///         turns towards the mouth as far as needed. If not even a level shovel holds the volume at
///         repose, the heap becomes steeper.
/// Omits   Soil in excess of a heap of 85 deg, the steepest one drawn.
struct HeapSurface {
  std::vector<Vec3> p_B_m;
  std::vector<Vec3> floor_B_m;  ///< the shell below each point
  /// position of each point along and across the mouth, as in HeapRelief
  std::vector<Vec2> place_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise from above
};

/// Columns are about `cell_m` apart. Empty for an empty shovel.
HeapSurface MakeHeapSurface(const ShovelShape& shape, const CarriedHeap& heap, double cell_m,
                            const HeapRelief& relief);

}  // namespace tera
