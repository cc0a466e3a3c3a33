#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "soil/tool/heap_grid.h"
#include "soil/tool/shovel_shape.h"

namespace tera {

/// Soil that lies in a shovel.
struct CarriedHeap {
  double volume_m3 = 0;
  Vec3 up_B = Vec3::UnitZ();          ///< against gravity
  Vec3 surface_up_B = Vec3::UnitZ();  ///< normal of the plane that its surface lies about
  double repose_rad = 0;
};

/// The surface of the soil in a shovel, as triangles.
///
/// Frames  B frame of the shovel's link.
/// Model   The heap of HeapGrid under which there is just the volume carried. The shovel may carry
///         more than stands at the angle of repose, because soil takes time to leave or sticks. The
///         heap then turns towards the mouth as far as it must. Soil that would not stand in a
///         level shovel either stands steeper.
/// Omits   soil beyond the heap of 85 deg, which is the steepest drawn.
struct HeapSurface {
  std::vector<Vec3> p_B_m;
  std::vector<Vec3> floor_B_m;  ///< the shell below each point
  std::vector<Vec2> place_m;    ///< of each point along and across the mouth, as of a HeapRelief
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise seen from above
};

/// Columns are about `cell_m` apart. Nothing where nothing is carried.
HeapSurface MakeHeapSurface(const ShovelShape& shape, const CarriedHeap& heap, double cell_m,
                            const HeapRelief& relief);

}  // namespace tera
