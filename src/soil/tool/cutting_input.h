#pragma once

namespace tera {

/// A plane blade, and the soil that it cuts.
struct CuttingInput {
  double width_m = 1;
  double depth_m = 0;   ///< upright, from the surface to the edge
  double rake_rad = 0;  ///< between blade and level, 90 deg is upright
  double density_kgpm3 = 0;
  double friction_rad = 0;
  double tool_friction_rad = 0;
  double cohesion_pa = 0;
  double adhesion_pa = 0;
  double surcharge_pa = 0;
  double overburden_pa = 0;    ///< weight of soil above, where this is a layer below others: a
                               ///< surcharge that presses on the flanks as well
  double flank_above_npm = 0;  ///< shear on a flank of those others, for each metre of length
  double speed_mps = 0;        ///< over ground, its level part
  double slope_rad = 0;        ///< the ground rises ahead
  double firm_slope_rad = 0;   ///< of the soil under a heap of loose soil
  double flank_share =
      0;  ///< of the two flanks' shear: 1 for a whole tool, 1/n for one of n strips
};

}  // namespace tera
