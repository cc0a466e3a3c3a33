#pragma once

#include <cstdint>
#include <span>

#include "core/types/measurement.h"
#include "core/workers.h"
#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// Converts four-channel to three-channel sRGB pixels.
Image<std::uint8_t> ColourOf(std::span<const std::uint8_t> rgba, int width_px, int height_px,
                             Workers* workers);

/// Luminance in cd/m2 of a linear image in which `white_cdpm2` maps to 1.
Image<float> ReadLuminance(const GlObject& colour, int width_px, int height_px, double white_cdpm2);

/// Depth in m from the GPU's values near_m / depth. 0 for the sky and beyond the camera's far
/// distance.
Image<float> DepthOf(std::span<const float> stored, const CameraIntrinsics& camera,
                     Workers* workers);

}  // namespace tera
