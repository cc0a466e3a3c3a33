#pragma once

#include <array>

#include "soil/columns/columns.h"
#include "soil/tool/cutting_input.h"
#include "soil/tool/earthmoving.h"

namespace tera {

/// The ground ahead of an edge, in the upright plane along its travel.
///
/// Frames  x ahead of the edge, heights above it.
/// Model   Surface and top of the firm soil, at places whose spacing grows with their distance.
///         Right at the edge a shovel leaves no ground. There the nearest line of the ground ahead
///         continues the surface, up to 25 deg steep.
struct GroundAhead {
  static constexpr int kPlaces = 20;

  std::array<double, kPlaces> x_m{}, top_m{}, firm_m{};

  double depth_m() const { return top_m[0]; }
};

/// As it lies from `near_m` ahead of a point on; no farther up than the surface there where that
/// lies below the point.
GroundAhead LookAhead(const Vec3& p_W, double near_m, const Vec3& travel_W, const Columns& ground);

/// Soil ahead of a blade, in addition to its mean in CuttingInput.
struct SoilAhead {
  double firm_density_kgpm3 = 0, loose_density_kgpm3 = 0;
  double firm_cohesion_pa = 0;  ///< loose soil has none
  double blade_m = 0;           ///< the blade's length, from edge to top
  double carried_npm = 0;       ///< weight for each metre of width that rests on the lifted soil
  double carried_over_m = 1;    ///< length that it covers at least
};

/// The force that a blade needs to move the soil ahead: the least over slip surfaces through the
/// ground as it lies.
///
/// Frames  x ahead of the edge, heights above it.
/// Model   Soil fails where that takes least. The search covers
///         - planes from the edge to where they first come out of the ground;
///         - logarithmic spirals from the edge to there, which bulge below those planes, by the
///           equation of moments of CurvedSlip;
///         - planes from the edge to the top of the firm soil. The loose soil beyond slides on it
///           as far as that is cheaper than pushing Rankine's wedge up through it.
///         Weight, cohesion of the firm soil and shear on the flanks are summed up over upright
///         slices between slip surface and ground, on the blade as far as it reaches. So a heap
///         takes no more than sliding it, and a slope no more than there is of it.
/// Omits   slopes across the travel; several strata of firm soil, which count by their mean
///         (CutLayers).
/// Source  Coulomb 1776 (trial wedges); Terzaghi 1943, ch. 7 (spirals); NAVFAC DM 7.01, 1986, ch. 7
///         (a block on a weak seam and the wedge that resists it).
CuttingForce CutAhead(const CuttingInput& in, const GroundAhead& ground, const SoilAhead& soil);

}  // namespace tera
