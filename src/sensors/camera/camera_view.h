#pragma once

#include "sensors/camera/camera.h"
#include "sensors/view_field.h"

namespace tera {

/// Model   the area of the picture per steradian by the camera's intrinsics, lens included. Depth
///         has the noise of Camera.
/// Omits   light: a camera sees whatever it looks at, as far as its pictures go.
ViewField ViewOf(const CameraModel& model, double rate_hz);

}  // namespace tera
