#pragma once

#include "sensors/camera/camera.h"
#include "sensors/view_field.h"

namespace tera {

/// Field of view of a camera.
///
/// Model   image area per steradian from the camera's intrinsics, lens included. Range limits are
///         planes across the optical axis, or spheres about the eye if depth is the distance.
///         Colour and labels extend from near_m to the horizon; depth has its own limits and noise.
///         Colour shows surfaces behind glass; depth and labels show the glass (Rasterizer).
/// Omits   light: a camera sees every surface in its field.
ViewField ViewOf(const CameraModel& model, double rate_hz);

}  // namespace tera
