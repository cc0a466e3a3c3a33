#pragma once

#include <optional>

#include "core/motion.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// True if Project and RayOf support the lens.
bool IsProjectable(const CameraLens& lens);

/// Image coordinates of a point in the optical frame; they may lie outside the image. Returns
/// nullopt for a point behind the camera or more than 50 degrees off axis, where the distortion
/// polynomial may not be monotonic.
///
/// Frames  C optical (x right, y down, z forward); pixel centres are integers.
/// Model   radial k1 k2 k3, tangential p1 p2.
/// Source  Brown 1966; OpenCV, "Camera Calibration and 3D Reconstruction".
std::optional<Vec2> Project(const Vec3& p_C_m, const CameraLens& lens);

/// Unit vector along the line of sight of a pixel. Inverts Project by iteration.
std::optional<Vec3> RayOf(const Vec2& pixel_px, const CameraLens& lens);

/// Converts from the sensor frame S (x forward, y left, z up) to the optical frame.
inline Vec3 OpticalOf(const Vec3& p_S_m) { return {-p_S_m.y(), -p_S_m.z(), p_S_m.x()}; }
/// Converts from the optical frame to the sensor frame.
inline Vec3 SensorOf(const Vec3& p_C_m) { return {p_C_m.z(), -p_C_m.x(), -p_C_m.y()}; }

}  // namespace tera
