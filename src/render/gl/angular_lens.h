#pragma once

#include <optional>

#include "render/gl/camera_intrinsics.h"

/// Lenses whose pictures follow the angle from the axis (fisheyes), as CameraIntrinsics has them.

namespace tera {

/// Of a point in C from its z axis, 0 to pi.
double AngleFromAxis(const Vec3& p_C);

/// Distance from the principal point over the focal length, and its derivative by the angle.
struct LensRadius {
  double rho, slope;
};
LensRadius RadiusAt(const CameraIntrinsics& lens, double theta_rad);

/// The angle within the field at which the radius is `rho`; the field's edge beyond it.
double AngleOf(const CameraIntrinsics& lens, double rho);

/// The unit vector in C at the angle `theta_rad` from z, towards `side` in the x-y plane.
Vec3 AlongAngle(double theta_rad, const Vec2& side);

/// A pixel of the picture at which the radius stops growing with the angle, within the field.
std::optional<Vec2> PixelWhereItFolds(const CameraIntrinsics& lens);

/// The field that the picture shows: the lens's own, or less where it ends at the picture's corner
/// that is farthest from the axis.
double FieldInPicture_rad(const CameraIntrinsics& lens);

/// Solid angle that an area of the picture sees, over that on the axis.
///
/// Model   sin(theta) / (rho rho'). That is the light on the picture over that on the axis if the
///         pupil turns towards what it sees, as fisheyes' do.
/// Source  Miyamoto 1964, "Fish eye lens".
double SolidAnglePerArea(const CameraIntrinsics& lens, double theta_rad);

}  // namespace tera
