#include "physics/running_gear.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// Patches are about this long: three cells of the default terrain, so that neighbouring patches
/// feel neighbouring ground.
constexpr double kBottomPatch_m = 0.16;
/// A nose carries patches up to this angle from straight down, in steps.
constexpr double kNoseAngle_rad = 80 * kDeg;
constexpr int kNosePatches = 4;
/// A tyre carries patches this far to either side of straight down.
constexpr double kTyreAngle_rad = 50 * kDeg;
constexpr int kTyrePatches = 9;
/// Segments of the shoes' path around half a sprocket.
constexpr int kPathSegments = 16;

/// The patch on a circle of `radius_m` about `center_B_m` at `angle_rad` from straight down,
/// positive towards the front. Driving forward moves the front of a wheel down and its bottom back.
ContactPatch PatchOnCircle(const Vec3& center_B_m, double radius_m, double angle_rad,
                           double span_rad, double width_m) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad);
  ContactPatch patch;
  patch.outward_B = Vec3(s, 0, -c);
  patch.travel_B = Vec3(-c, 0, -s);
  patch.p_B_m = center_B_m + radius_m * patch.outward_B;
  patch.length_m = radius_m * span_rad;
  patch.width_m = width_m;
  return patch;
}

}  // namespace

std::vector<ContactPatch> TrackPatches(const TrackShape& track) {
  const Vec3 rear = track.center_B_m - 0.5 * track.wheelbase_m * Vec3::UnitX();
  const Vec3 front = track.center_B_m + 0.5 * track.wheelbase_m * Vec3::UnitX();
  const double nose_span_rad = kNoseAngle_rad / kNosePatches;
  std::vector<ContactPatch> patches;
  for (int i = kNosePatches - 1; i >= 0; --i) {
    patches.push_back(PatchOnCircle(rear, track.radius_m, -(i + 0.5) * nose_span_rad, nose_span_rad,
                                    track.width_m));
  }
  const int count = std::max(1, static_cast<int>(std::lround(track.wheelbase_m / kBottomPatch_m)));
  for (int i = 0; i < count; ++i) {
    ContactPatch patch;
    patch.p_B_m = rear + Vec3((i + 0.5) * track.wheelbase_m / count, 0, -track.radius_m);
    patch.length_m = track.wheelbase_m / count;
    patch.width_m = track.width_m;
    patches.push_back(patch);
  }
  for (int i = 0; i < kNosePatches; ++i) {
    patches.push_back(PatchOnCircle(front, track.radius_m, (i + 0.5) * nose_span_rad, nose_span_rad,
                                    track.width_m));
  }
  return patches;
}

std::vector<ContactPatch> WheelPatches(const WheelSetShape& wheels) {
  const double span_rad = 2 * kTyreAngle_rad / kTyrePatches;
  std::vector<ContactPatch> patches;
  for (const Vec3& axle : wheels.axles_B_m) {
    for (int i = 0; i < kTyrePatches; ++i) {
      patches.push_back(PatchOnCircle(axle, wheels.radius_m, (i + 0.5) * span_rad - kTyreAngle_rad,
                                      span_rad, wheels.width_m));
    }
  }
  return patches;
}

std::vector<Vec3> TrackPath(const TrackShape& track) {
  const Vec3 half = 0.5 * track.wheelbase_m * Vec3::UnitX();
  std::vector<Vec3> path;
  // Rear half circle from the bottom up, then front half circle from the top down.
  for (int i = 0; i <= kPathSegments; ++i) {
    const double a = kPi * i / kPathSegments;
    path.push_back(track.center_B_m - half + track.radius_m * Vec3(-std::sin(a), 0, -std::cos(a)));
  }
  for (int i = 0; i <= kPathSegments; ++i) {
    const double a = kPi * i / kPathSegments;
    path.push_back(track.center_B_m + half + track.radius_m * Vec3(std::sin(a), 0, std::cos(a)));
  }
  return path;
}

}  // namespace tera
