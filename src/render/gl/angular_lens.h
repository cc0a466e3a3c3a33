#pragma once

#include <optional>

#include "render/gl/camera_intrinsics.h"

/// Lenses whose projection is a function of the angle from the axis (fisheyes); see
/// CameraIntrinsics.

namespace tera {

/// Angle of a point in C from the z axis, 0 to pi.
double AngleFromAxis(const Vec3& p_C);

/// Image radius over the focal length, and its derivative with respect to the angle.
struct LensRadius {
  double rho, slope;
};
LensRadius RadiusAt(const CameraIntrinsics& lens, double theta_rad);

/// The angle within the field whose radius is `rho`; the field's edge for a larger `rho`.
double AngleOf(const CameraIntrinsics& lens, double rho);

/// Unit vector in C at the angle `theta_rad` from z, in the azimuth of `side` in the x-y plane.
Vec3 AlongAngle(double theta_rad, const Vec2& side);

/// A pixel at which the radius stops growing with the angle, within the field.
std::optional<Vec2> PixelWhereItFolds(const CameraIntrinsics& lens);

/// Half field in the image: the lens's own, or less if it ends at the corner farthest from the
/// axis.
double FieldInPicture_rad(const CameraIntrinsics& lens);

/// Solid angle of an image area, relative to the axis.
///
/// Model   sin(theta) / (rho rho'). It equals the relative illumination if the pupil tilts towards
///         the scene, as in fisheyes.
/// Source  Miyamoto 1964, "Fish eye lens".
double SolidAnglePerArea(const CameraIntrinsics& lens, double theta_rad);

}  // namespace tera
