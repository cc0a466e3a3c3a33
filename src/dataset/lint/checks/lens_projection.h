#pragma once

#include <optional>

#include "core/motion.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {

/// Whether Project and RayOf know a lens.
bool IsProjectable(const CameraLens& lens);

/// Where a picture without end has a point of the camera's optical frame; nothing behind the camera
/// and beyond 50 degrees from its axis, where the polynomials of a lens may turn back.
///
/// Frames  C optical (x right, y down, z forward); pixel centres are whole numbers.
/// Model   radial k1 k2 k3, tangential p1 p2.
/// Source  Brown 1966; OpenCV, "Camera Calibration and 3D Reconstruction".
std::optional<Vec2> Project(const Vec3& p_C_m, const CameraLens& lens);

/// The direction that a pixel sees, of length 1: Project's inverse by iteration.
std::optional<Vec3> RayOf(const Vec2& pixel_px, const CameraLens& lens);

/// From the sensor frame S (x forward, y left, z up) to the optical frame.
inline Vec3 OpticalOf(const Vec3& p_S_m) { return {-p_S_m.y(), -p_S_m.z(), p_S_m.x()}; }
/// And back.
inline Vec3 SensorOf(const Vec3& p_C_m) { return {p_C_m.z(), -p_C_m.x(), -p_C_m.y()}; }

}  // namespace tera
