#pragma once

#include <array>

#include "soil/columns/columns.h"

namespace tera {

/// The ground ahead of an edge, in the upright plane along its travel.
///
/// Frames  x ahead of the edge, heights above it.
/// Model   Surface and top of what stands firm at places that lie the farther apart the farther
///         they are. Right at the edge, where a shovel leaves no ground to look at, the surface
///         goes on from what stands ahead as the line nearest to that does, up to 25 deg steep.
struct GroundAhead {
  static constexpr int kPlaces = 20;

  std::array<double, kPlaces> x_m{}, top_m{}, firm_m{};

  double depth_m() const { return top_m[0]; }
};

/// As it lies from `near_m` ahead of a point on; no farther up than the surface there where that
/// lies below the point.
GroundAhead LookAhead(const Vec3& p_W, double near_m, const Vec3& travel_W, const Columns& ground);

}  // namespace tera
