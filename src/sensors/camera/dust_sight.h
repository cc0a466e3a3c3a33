#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Optical depth in thousandths, saturated at 65535.
inline std::uint16_t PixelOfOpticalDepth(double depth) {
  constexpr double kPerOne = 1000, kLargest = 65535;
  return static_cast<std::uint16_t>(std::clamp(std::round(kPerOne * depth), 0.0, kLargest));
}

/// Optical depth of dust in front of each pixel's surface, from its exact depth. A sky pixel gets
/// all dust along its ray. Zero without dust.
Image<float> DustOpticalDepths(const PixelRays& rays, const SeenScene& scene,
                               const Image<float>& depth_m);

/// The label dust_optical_depth.
Image<std::uint16_t> DustLabel(const Image<float>& optical_depth);

/// Optical depth of the air in front of each pixel's surface: uniform extinction `extinction_1pm`
/// plus `dust`, which may be empty. Zero for the sky, apart from dust.
Image<float> AirOpticalDepths(const PixelRays& rays, double extinction_1pm, Image<float> dust,
                              const Image<float>& depth_m);

/// Contrast below which depth is lost in the air: 5 %, the threshold of the meteorological optical
/// range (WMO-No. 8, 2018, part I, 9.1.1).
inline constexpr double kLeastContrast = 0.05;
/// Removes depth at pixels below kLeastContrast.
void LoseDepthInAir(const Image<float>& optical_depth, Image<float>* depth_m);

}  // namespace tera
