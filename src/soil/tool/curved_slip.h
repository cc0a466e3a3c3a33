#pragma once

#include "soil/tool/cutting_input.h"

/// The force that a blade needs to cut soil along a curved slip surface.
///
/// Frames  level x ahead, upright z; all angles are from the level, as in earthmoving.h.
/// Model   The slip surface is a logarithmic spiral r = r_0 exp(theta tan phi). It leaves the edge
///         at one angle and reaches the surface at another, steeper by its turn. The spiral's
///         normal and friction stresses act towards its pole, so that moments about the pole give
///         P. The weight's part of P acts at the lower third of the blade, the part of cohesion,
///         adhesion and surcharge at its middle. The two angles are those that make P least. With
///         no turn the spiral is a plane, and P that of the earthmoving equation. Inertia acts
///         along the surface, shear on the flanks at the middle of their area.
/// Omits   a plane zone above the spiral. Where soil rubs on soil P is 7 to 11 % more than in the
///         tables of Caquot and Kerisel (1948) at 30 to 40 deg. The search finds the least P within
///         1 % on level ground and 13 % on slopes of 25 deg, for faces that lean back or stand
///         upright, with friction near that of the soil.
/// Source  Terzaghi 1943, Theoretical Soil Mechanics, ch. 7; Soubra and Macuh 2002, Active and
///         passive earth pressure coefficients by a kinematical approach (the moments are theirs).

namespace tera {

/// P for a spiral that comes out at `exit_rad`, `turn_rad` > 0 steeper than it leaves the edge;
/// infinite where none such holds the soil up.
double CurvedSlipForceAt_n(const CuttingInput& in, double exit_rad, double turn_rad);

/// The least P.
double CurvedSlipForce_n(const CuttingInput& in);

}  // namespace tera
