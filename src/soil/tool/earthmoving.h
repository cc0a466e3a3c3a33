#pragma once

#include "soil/tool/cutting_input.h"

/// The fundamental earthmoving equation: the force that a plane blade needs to cut soil.
///
/// Model   The wedge between blade and the slip plane is in limit equilibrium:
///         P = w (rho g d^2 N_gamma + c d N_c + c_a d N_a + q d N_q) + inertia, with the slip
///         plane's angle beta that makes P least. All angles are from the level, gravity is
///         upright, and `depth_m` is the surface's height above the edge. On ground that rises
///         ahead by `slope_rad` the slip plane comes out d / (tan beta - tan slope) ahead. The
///         length sets the size of the wedge, of its slip plane and of the blade in the ground. All
///         soil on the blade behind the upright line through the edge counts with its full weight
///         (Luengo's swept volume). Shear on the wedge's two flanks is added to the slip plane's
///         cohesion.
/// Omits   bent blades, the rest of the tool, three-dimensional wedges beyond the flanks' shear.
/// Source  Reece 1964; McKyes 1985, Soil Cutting and Tillage; slope after Luengo, Singh and Cannon
///         1998, which measures angles from the surface and turns gravity in them: the same force.

namespace tera {

struct CuttingFactors {
  double wedge_rad = 0;  ///< beta, between slip plane and level
  double n_gamma = 0, n_c = 0, n_a = 0, n_q = 0;
  double inertia = 0;  ///< force per rho v^2 w d
};

struct CuttingForce {
  double total_n = 0;     ///< P
  double draft_n = 0;     ///< level, against the tool's travel
  double vertical_n = 0;  ///< positive pulls the tool in
  double wedge_rad = 0;
  double wedge_length_m = 0;  ///< of ground, seen from above, that the wedge lifts ahead
};

/// Factors at a given wedge angle; valid while rake + tool friction + wedge + friction < 180 deg.
CuttingFactors CuttingFactorsAt(const CuttingInput& in, double wedge_rad);

/// A face that leans forwards traps soil beneath it, which moves on with it. It counts as an
/// upright face, with the friction that turns the force as far, of soil on soil at most. Others as
/// they are.
CuttingInput AsUpright(CuttingInput in);

/// The force with the wedge angle that makes it least. Zero for zero depth.
CuttingForce PlaneCut(const CuttingInput& in);

/// The same, or that along the curved slip surface of curved_slip.h where that takes less.
CuttingForce Cut(const CuttingInput& in);

}  // namespace tera
