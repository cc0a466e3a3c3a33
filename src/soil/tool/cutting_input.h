#pragma once

namespace tera {

/// A plane blade and the soil that it cuts.
struct CuttingInput {
  double width_m = 1;
  double depth_m = 0;   ///< vertical, from the surface to the edge
  double rake_rad = 0;  ///< angle between blade and horizontal; 90 deg is vertical
  double density_kgpm3 = 0;
  double friction_rad = 0;
  double tool_friction_rad = 0;
  double cohesion_pa = 0;
  double adhesion_pa = 0;
  double surcharge_pa = 0;
  /// weight of the layers above a deeper layer: a surcharge that also acts on the flanks
  double overburden_pa = 0;
  double flank_above_npm = 0;  ///< shear on one flank of the layers above, per metre of length
  double speed_mps = 0;        ///< horizontal speed over ground
  double slope_rad = 0;        ///< slope of the surface; positive if it rises ahead
  double firm_slope_rad = 0;   ///< slope of the firm soil under a heap of loose soil
  double flank_share =
      0;  ///< share of the shear on both flanks: 1 for a whole tool, 1/n for one of n strips
};

}  // namespace tera
