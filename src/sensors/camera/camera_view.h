#pragma once

#include "sensors/camera/camera.h"
#include "sensors/view_field.h"

namespace tera {

/// Field of view of a camera.
///
/// Model   Image area per steradian from the intrinsics, lens included. Range limits are planes
///         across the optical axis, or spheres about the eye if depth is the distance. Colour and
///         labels extend from near_m to the horizon. Depth has its own limits and noise. Colour
///         shows surfaces behind glass; depth and labels show the glass (Rasterizer).
/// Omits   Light: every surface in the field counts as visible.
ViewField ViewOf(const CameraModel& model, double rate_hz);

}  // namespace tera
