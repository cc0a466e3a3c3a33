#pragma once

#include <optional>

#include "render/gl/camera_intrinsics.h"

/// Fisheye lenses, whose image radius is a function of the angle from the optical axis. See
/// CameraIntrinsics.

namespace tera {

/// Angle of a point in C from the z axis, 0 to pi.
double AngleFromAxis(const Vec3& p_C);

/// Image radius divided by the focal length, and its derivative by the angle.
struct LensRadius {
  double rho, slope;
};
LensRadius RadiusAt(const CameraIntrinsics& lens, double theta_rad);

/// Inverse of RadiusAt within the field. The edge of the field for a larger `rho`.
double AngleOf(const CameraIntrinsics& lens, double rho);

/// Unit vector in C at the angle `theta_rad` from z, towards `side` in the x-y plane.
Vec3 AlongAngle(double theta_rad, const Vec2& side);

/// A pixel within the field at which the radius stops growing with the angle. Empty for a valid
/// lens.
std::optional<Vec2> PixelWhereItFolds(const CameraIntrinsics& lens);

/// Largest angle from the axis that the image shows: half the lens's field, or less if the farthest
/// image corner cuts it.
double FieldInPicture_rad(const CameraIntrinsics& lens);

/// Solid angle per image area, relative to that on the axis.
///
/// Model   sin(theta) / (rho rho'). It equals the relative illumination if the pupil tilts towards
///         the scene, as in fisheyes.
/// Source  Miyamoto 1964, "Fish eye lens".
double SolidAnglePerArea(const CameraIntrinsics& lens, double theta_rad);

}  // namespace tera
