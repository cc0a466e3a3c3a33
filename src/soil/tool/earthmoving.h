#pragma once

#include "soil/tool/cutting_input.h"

/// Fundamental earthmoving equation: the force that a plane blade needs to cut soil.
///
/// Model   The wedge between blade and slip plane is in limit equilibrium: P = w (rho g d^2 N_gamma
///         + c d N_c + c_a d N_a + q d N_q) + inertia. The angle beta of the slip plane minimises
///         P. All angles are from horizontal, gravity is vertical, and `depth_m` is the height of
///         the surface above the edge. Where the surface rises ahead by `slope_rad`, the slip plane
///         ends d / (tan beta - tan slope) ahead. This length sets the size of the wedge, of the
///         slip plane and of the blade in the ground. Soil on the blade behind the vertical through
///         the edge counts with its full weight (Luengo's swept volume). Shear on the two flanks of
///         the wedge adds to the cohesion of the slip plane.
/// Omits   Bent blades, the rest of the tool, three-dimensional wedges beyond the shear on the
///         flanks.
/// Source  Reece 1964; McKyes 1985, Soil Cutting and Tillage; slope: Luengo, Singh and Cannon 1998.
///         They measure angles from the surface and rotate gravity, which gives the same force.

namespace tera {

struct CuttingFactors {
  double wedge_rad = 0;  ///< beta, between slip plane and horizontal
  double n_gamma = 0, n_c = 0, n_a = 0, n_q = 0;
  double inertia = 0;  ///< force per rho v^2 w d
};

struct CuttingForce {
  double total_n = 0;     ///< P of the equation
  double draft_n = 0;     ///< horizontal, against the travel of the tool
  double vertical_n = 0;  ///< vertical; positive pulls the tool in
  double wedge_rad = 0;
  double wedge_length_m = 0;  ///< horizontal length of ground ahead that the wedge lifts
};

/// Factors at a wedge angle. Valid while rake + tool friction + wedge + friction < 180 deg.
CuttingFactors CuttingFactorsAt(const CuttingInput& in, double wedge_rad);

/// Replaces a blade that leans forwards by a vertical one. The soil trapped below the blade moves
/// with it. The lean is added to the tool friction, up to the soil friction. Other blades stay
/// unchanged.
CuttingInput AsUpright(CuttingInput in);

/// The least force over plane slip surfaces. Zero for zero depth.
CuttingForce PlaneCut(const CuttingInput& in);

/// The least force over plane slip surfaces and the curved ones of curved_slip.h.
CuttingForce Cut(const CuttingInput& in);

}  // namespace tera
