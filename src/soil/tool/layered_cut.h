#pragma once

#include <span>

#include "soil/tool/cut_soil.h"
#include "soil/tool/cutting_input.h"
#include "soil/tool/earthmoving.h"
#include "soil/tool/slip_ahead.h"

namespace tera {

/// Force that a plane blade needs to cut layered soil: the least over slip surfaces that use the
/// weakest layers.
///
/// Model   The search covers three kinds of surfaces:
///         - One plane through all layers, with the mean strength over the depth.
///         - A surface with a kink at each border. Each layer slips at the angle of its own least
///           force, under the layers above as surcharge, and the forces add up. With one common
///           angle this is the earthmoving equation.
///         - For each border with a softer layer below: the layers above slide on that layer as one
///           block, as long as it is thick. The block pushes Rankine's passive wedge ahead. The
///           layers below slip as in the second kind. The vertical force of the blade presses the
///           block down or lifts it.
///         In soil of uniform strength only the first kind remains. Borders are parallel to the
///         surface; under loose soil they follow the slope of the firm soil. Where the layers end
///         above the edge, the lowest one continues. Wedge angle and length are always those of the
///         plane.
/// Omits   Soft soil just below the edge, cracks, crusts that bend, inertia of the block and of its
///         wedge. Shear between layers that slip at different angles, so that the second kind is no
///         strict upper bound.
/// Source  Chen 1975, Limit Analysis and Soil Plasticity, ch. 5 (least of upper bounds); Bowles
///         1996, Foundation Analysis and Design, ch. 11 (layered backfill); NAVFAC DM 7.01, 1986,
///         ch. 7 (block on a weak seam and its resisting wedge).
CuttingForce CutLayers(const CuttingInput& mean, std::span<const CutLayer> layers);

/// Force to move the ground ahead (CutAhead), reduced by the ratio of layered to mean soil on level
/// ground. `ground` and `soil` replace the depth and soil of `blade`. `ahead` provides only the
/// load on the blade.
CuttingForce CutLayersAhead(const CuttingInput& blade, const GroundAhead& ground,
                            const CutSoil& soil, const SoilAhead& ahead);

/// Input of the blade with the soil of a layer.
CuttingInput InSoilOf(const CutLayer& layer, CuttingInput in);

}  // namespace tera
