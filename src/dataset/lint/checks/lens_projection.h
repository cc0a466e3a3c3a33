#pragma once

#include <optional>

#include "core/motion.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// Whether Project and RayOf support a lens.
bool IsProjectable(const CameraLens& lens);

/// Image of a point of the camera's optical frame, in an unbounded picture. Nothing for a point
/// behind the camera or beyond 50 degrees from its axis, where a lens polynomial may turn back.
///
/// Frames  C optical (x right, y down, z forward); pixel centres are integers.
/// Model   radial k1 k2 k3, tangential p1 p2.
/// Source  Brown 1966; OpenCV, "Camera Calibration and 3D Reconstruction".
std::optional<Vec2> Project(const Vec3& p_C_m, const CameraLens& lens);

/// The unit vector along a pixel's line of sight: Project's inverse by iteration.
std::optional<Vec3> RayOf(const Vec2& pixel_px, const CameraLens& lens);

/// From the sensor frame S (x forward, y left, z up) to the optical frame.
inline Vec3 OpticalOf(const Vec3& p_S_m) { return {-p_S_m.y(), -p_S_m.z(), p_S_m.x()}; }
/// From the optical frame to the sensor frame.
inline Vec3 SensorOf(const Vec3& p_C_m) { return {p_C_m.z(), -p_C_m.x(), -p_C_m.y()}; }

}  // namespace tera
