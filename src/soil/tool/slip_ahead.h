#pragma once

#include <array>

#include "soil/columns/columns.h"
#include "soil/tool/cutting_input.h"
#include "soil/tool/earthmoving.h"

namespace tera {

/// The ground ahead of an edge, in the vertical plane along its travel.
///
/// Frames  x ahead of the edge, heights above it.
/// Model   Heights of the surface and of the firm soil, at positions with growing spacing. At the
///         edge itself the shovel has removed the ground. There a line fitted to the nearest ground
///         extrapolates the surface, at up to 25 deg.
struct GroundAhead {
  static constexpr int kPlaces = 20;

  std::array<double, kPlaces> x_m{}, top_m{}, firm_m{};

  double depth_m() const { return top_m[0]; }
};

/// Samples the ground from `near_m` ahead of a point. If the surface there lies below the point,
/// all other values stay zero.
GroundAhead LookAhead(const Vec3& p_W, double near_m, const Vec3& travel_W, const Columns& ground);

/// Properties of the soil ahead of a blade that CuttingInput does not contain.
struct SoilAhead {
  double firm_density_kgpm3 = 0, loose_density_kgpm3 = 0;
  double firm_cohesion_pa = 0;  ///< loose soil has no cohesion
  double blade_m = 0;           ///< length of the blade from edge to top
  double carried_npm = 0;       ///< weight per metre of width on the lifted soil
  double carried_over_m = 1;    ///< least length over which this weight is spread
};

/// Force that a blade needs to move the soil ahead: the least over slip surfaces through the actual
/// ground.
///
/// Frames  x ahead of the edge, heights above it.
/// Model   The search covers three kinds of surfaces:
///         - Planes from the edge to their first exit from the ground.
///         - Logarithmic spirals between the same points, which bulge below the planes. They follow
///           the moment equation of curved_slip.h.
///         - Planes from the edge to the top of the firm soil. The loose soil beyond slides on the
///           firm soil, as far as this takes less force than Rankine's wedge through it.
///         Weight, cohesion of the firm soil and shear on the flanks are summed over vertical
///         slices between slip surface and ground. Soil on the blade counts over the length of the
///         blade. So a heap needs at most the force that slides it as a whole. A short slope needs
///         at most the force for its own soil.
/// Omits   Slopes across the travel. Several strata of firm soil, which count by their mean
///         (CutLayers).
/// Source  Coulomb 1776 (trial wedges); Terzaghi 1943, ch. 7 (spirals); NAVFAC DM 7.01, 1986, ch. 7
///         (block on a weak seam and its resisting wedge).
CuttingForce CutAhead(const CuttingInput& in, const GroundAhead& ground, const SoilAhead& soil);

}  // namespace tera
