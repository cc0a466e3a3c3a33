#pragma once

#include <array>
#include <cstdint>

#include "core/motion.h"
#include "core/types/measurement.h"

/// Motion between two pictures as the three values of a pixel.

namespace tera {

/// What becomes of the point that a pixel shows.
enum class FlowState : std::uint16_t {
  kUnknown = 0,  ///< its motion is not known, or too far to be stored
  kSeen = 1,     ///< the other picture shows it
  kHidden = 2,   ///< it lies on the other picture behind something else
  kOutside = 3   ///< beyond the other picture; with the place that it has there, if it has one
};

/// Flow on the picture: where the other picture has the point, less where this one has it.
///
/// Model   v = round(64 flow_px + 32768) for u (right) and v (down), as in the development kit of
///         KITTI 2015, whose readers take any third value but 0 for valid; the third value is a
///         FlowState. 0 0 0 where nothing is known.
std::array<std::uint16_t, 3> PixelOfFlow(const Vec2& flow_px, FlowState state);

struct PixelFlow {
  Vec2 flow_px;
  FlowState state;
};
PixelFlow FlowAt(const Image<std::uint16_t>& flow, int x_px, int y_px);

/// How far a point moves in the camera's frame C.
///
/// Model   v = round(1000 d_m + 32768) for x, y and z: whole millimetres up to 32.7 m; 0 0 0 where
///         nothing is known.
std::array<std::uint16_t, 3> PixelOfShift(const Vec3& d_C_m);

}  // namespace tera
