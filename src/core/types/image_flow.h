#pragma once

#include <array>
#include <cstdint>

#include "core/motion.h"
#include "core/types/measurement.h"

/// Optical flow and scene flow as the three values of a pixel.

namespace tera {

/// Visibility in the other image of the point at a pixel.
enum class FlowState : std::uint16_t {
  kUnknown = 0,  ///< unknown motion, or out of the storable range
  kSeen = 1,     ///< visible in the other image
  kHidden = 2,   ///< occluded in the other image
  kOutside = 3   ///< outside the other image; has a flow if the point has a projection
};

/// Optical flow: the point's pixel in the other image minus its pixel in this image.
///
/// Model   v = round(64 flow_px + 32768) for u (right) and v (down), as in the KITTI 2015
///         development kit. The third value is a FlowState; KITTI readers treat each non-zero value
///         as valid. Unknown flow is 0 0 0.
std::array<std::uint16_t, 3> PixelOfFlow(const Vec2& flow_px, FlowState state);

struct PixelFlow {
  Vec2 flow_px;
  FlowState state;
};
PixelFlow FlowAt(const Image<std::uint16_t>& flow, int x_px, int y_px);

/// Displacement of a point in the camera frame C (scene flow).
///
/// Model   v = round(1000 d_m + 32768) for x, y and z: whole millimetres up to 32.7 m. Unknown
///         displacement is 0 0 0.
std::array<std::uint16_t, 3> PixelOfShift(const Vec3& d_C_m);

}  // namespace tera
