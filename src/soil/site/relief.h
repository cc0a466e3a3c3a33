#pragma once

#include <cstdint>

#include "core/motion.h"

namespace tera {

/// Gently uneven ground.
///
/// Frames  W; heights are about zero at the origin of W.
/// Model   A plane of slope `slope_rad` that rises towards `slope_direction_rad` (from x towards
///         y), plus gradient noise of three octaves. Each octave has half the wavelength and half
///         the height of the one before.
/// Source  Perlin 2002, "Improving noise", for the lattice and its quintic blend.
struct Relief {
  double amplitude_m = 0;  ///< approximate greatest deviation from the plane
  double wavelength_m = 8;
  double slope_rad = 0;
  double slope_direction_rad = 0;
  std::uint64_t seed = 0;

  double HeightAt(double x_m, double y_m) const;
};

}  // namespace tera
