#pragma once

#include <cstdint>

#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "render/gl/gl_objects.h"

namespace tera {

/// sRGB, three channels.
Image<std::uint8_t> ReadColour(const GlObject& colour, int width_px, int height_px);

/// Luminance of a linear picture in which `white_cdpm2` is 1.
Image<float> ReadLuminance(const GlObject& colour, int width_px, int height_px, double white_cdpm2);

/// Depth in m of what is stored as near_m over it, in a texture read as `format`; 0 for the sky and
/// beyond the camera's far distance.
Image<float> ReadDepth(const GlObject& depth, unsigned format, const CameraIntrinsics& camera);

}  // namespace tera
