#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Thousandths of an optical depth; 65535: as much, or more.
inline std::uint16_t PixelOfOpticalDepth(double depth) {
  constexpr double kPerOne = 1000, kLargest = 65535;
  return static_cast<std::uint16_t>(std::clamp(std::round(kPerOne * depth), 0.0, kLargest));
}

/// Optical depth of the dust before what each pixel of `scene` shows, of that exact depth; before
/// the sky, of all dust on the way. Nothing where the pixel sees nothing.
Image<float> DustOpticalDepths(const PixelRays& rays, const SeenScene& scene,
                               const Image<float>& depth_m);

/// The label dust_optical_depth.
Image<std::uint16_t> DustLabel(const Image<float>& optical_depth);

/// Contrast of what a stereo pair matches, left over behind dust, below which it finds nothing: 5
/// %, the threshold of the meteorological optical range (WMO-No. 8, 2018, part I, 9.1.1).
inline constexpr double kLeastContrast = 0.05;
/// Takes away the depth that is seen with less contrast than that.
void LoseDepthInDust(const Image<float>& optical_depth, Image<float>* depth_m);

}  // namespace tera
