#pragma once

#include <array>
#include <cstdint>

#include "core/motion.h"
#include "core/types/measurement.h"

/// Encoding of optical flow and scene flow in the three values of a pixel.

namespace tera {

/// Visibility in the other image of the point seen at a pixel.
enum class FlowState : std::uint16_t {
  kUnknown = 0,  ///< its motion is unknown or exceeds the range of the encoding
  kSeen = 1,     ///< visible in the other image
  kHidden = 2,   ///< occluded in the other image
  kOutside = 3   ///< outside the other image's border; the flow is valid unless the point is behind
                 ///< the camera
};

/// Optical flow: pixel of a point in the other image minus its pixel in this image.
///
/// Model   v = round(64 flow_px + 32768) for u (right) and v (down), as in the KITTI 2015
///         development kit. The third value is a FlowState. KITTI readers treat every nonzero third
///         value as valid. A pixel with unknown flow holds 0 0 0.
std::array<std::uint16_t, 3> PixelOfFlow(const Vec2& flow_px, FlowState state);

struct PixelFlow {
  Vec2 flow_px;
  FlowState state;
};
PixelFlow FlowAt(const Image<std::uint16_t>& flow, int x_px, int y_px);

/// Scene flow: displacement of a point in the camera frame C.
///
/// Model   v = round(1000 d_m + 32768) for x, y and z, so the unit is 1 mm and the range is 32.7 m.
///         A pixel with unknown displacement holds 0 0 0.
std::array<std::uint16_t, 3> PixelOfShift(const Vec3& d_C_m);

}  // namespace tera
