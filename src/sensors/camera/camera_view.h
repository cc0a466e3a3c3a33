#pragma once

#include "sensors/camera/camera.h"
#include "sensors/view_field.h"

namespace tera {

/// Model   the area of the picture per steradian by the camera's intrinsics, lens included. Nearest
///         and farthest are planes across the optical axis, or spheres about the eye where depth is
///         the distance, as in Camera: colour and labels go on from near_m to the horizon, depth is
///         within its own limits and has its noise. Colour shows what lies behind glass, depth and
///         labels are those of the glass (Rasterizer).
/// Omits   light: a camera sees whatever it looks at.
ViewField ViewOf(const CameraModel& model, double rate_hz);

}  // namespace tera
