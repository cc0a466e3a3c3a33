#pragma once

#include "soil/tool/cutting_input.h"

/// Force that a blade needs to cut soil along a curved slip surface.
///
/// Frames  x ahead and horizontal, z up; all angles from horizontal, as in earthmoving.h.
/// Model   The slip surface is a logarithmic spiral r = r_0 exp(theta tan phi). It leaves the edge
///         at one angle and reaches the surface at a steeper one; the difference is its turn.
///         Normal and friction stresses on the spiral act towards its pole, so that moments about
///         the pole give P. The part of P from weight acts at the lower third of the blade. The
///         part from cohesion, adhesion and surcharge acts at its middle. Exit angle and turn are
///         those that minimise P. Without turn, the spiral is a plane and P is that of the
///         earthmoving equation. Inertia acts along the surface; shear on the flanks acts at the
///         centre of their area.
/// Omits   A plane zone above the spiral. Where soil rubs on soil, P is 7 to 11 % above the tables
///         of Caquot and Kerisel (1948) at 30 to 40 deg. The search finds the least P within 1 % on
///         level ground and 13 % on slopes of 25 deg. These figures hold for blades that lean back
///         or stand vertical, with tool friction near soil friction.
/// Source  Terzaghi 1943, Theoretical Soil Mechanics, ch. 7; Soubra and Macuh 2002, Active and
///         passive earth pressure coefficients by a kinematical approach (moments).

namespace tera {

/// P for a spiral with exit angle `exit_rad` and turn `turn_rad` > 0. Infinite if no such spiral is
/// in equilibrium.
double CurvedSlipForceAt_n(const CuttingInput& in, double exit_rad, double turn_rad);

/// The least P over all spirals.
double CurvedSlipForce_n(const CuttingInput& in);

}  // namespace tera
