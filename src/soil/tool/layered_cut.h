#pragma once

#include <span>

#include "soil/tool/cut_soil.h"
#include "soil/tool/cutting_input.h"
#include "soil/tool/earthmoving.h"
#include "soil/tool/slip_ahead.h"

namespace tera {

/// The force that a plane blade needs to cut soil in layers: the least of those along surfaces
/// that use the weakest of them.
///
/// Model   Soil fails where that takes least. The search covers
///         - one plane through all layers, as strong as they are on average over the depth;
///         - a surface with a kink at each border: each layer slips at the angle that makes its own
///           part of P least, under the weight of the layers above as a surcharge, and the parts
///           add up. With one angle for all it is that of the earthmoving equation;
///         - along each border to a softer soil below, layers above it slide on that soil as one
///           block, as long as thick. They push Rankine's passive wedge before them, while those
///           below slip as in the second. The blade's upright force presses the block down or
///           lifts it.
///         In soil of one strength only the first remains. Borders lie parallel to the surface, but
///         under loose soil they rise as the firm soil does.
///         Where layers reach less deep than the edge, the lowest goes on.
///         The wedge's angle and length are those of the plane, whichever surface is the least.
/// Omits   soft soil just below the edge, cracks, crusts that bend; shear along borders between
///         layers that slip at different angles, so that the second is no strict upper bound;
///         inertia of the block and of the wedge before it.
/// Source  Chen 1975, Limit Analysis and Soil Plasticity, ch. 5 (the least of upper bounds); Bowles
///         1996, Foundation Analysis and Design, ch. 11 (layered backfill); NAVFAC DM 7.01, 1986,
///         ch. 7 (a central block on a weak seam and its resisting wedge).
CuttingForce CutLayers(const CuttingInput& mean, std::span<const CutLayer> layers);

/// The force to move the ground that lies ahead (CutAhead). Layers weaker than soil of their mean
/// reduce it by the same share as on level ground. `ground` and `soil` replace the soil and depth
/// of `blade`; only the soil on the blade counts in `ahead`.
CuttingForce CutLayersAhead(const CuttingInput& blade, const GroundAhead& ground,
                            const CutSoil& soil, const SoilAhead& ahead);

/// The blade's input with the soil of a layer.
CuttingInput InSoilOf(const CutLayer& layer, CuttingInput in);

}  // namespace tera
