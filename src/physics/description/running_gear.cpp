#include "physics/description/running_gear.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// Approximate length of a patch: three cells of the default terrain, so that neighbouring patches
/// act on neighbouring ground.
constexpr double kBottomPatch_m = 0.16;
constexpr double kLeastPatch_m = 1e-6;  ///< shorter parts of the bottom run are rounding errors
/// Angle of a nose, from straight down to its upper end; the patches divide it evenly.
constexpr double kNoseAngle_rad = 80 * kDeg;
constexpr int kNosePatches = 4;
/// Contact angle of a tyre to either side of straight down; the patches divide it evenly.
constexpr double kTyreAngle_rad = 50 * kDeg;
constexpr int kTyrePatches = 9;
/// Segments of the shoes' path around half a sprocket.
constexpr int kPathSegments = 16;

/// The patch on a circle of `radius_m` about `center_B_m` at `angle_rad` from straight down,
/// positive towards the front. When the wheel drives forward, its front moves down and its bottom
/// moves back.
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

/// Appends equal parts of the bottom run between `from_m` and `to_m`, measured along x from its
/// middle.
void AddBottom(const TrackShape& track, double from_m, double to_m, bool under_wheels,
               std::vector<ContactPatch>* patches) {
  if (to_m - from_m < kLeastPatch_m) return;
  const int count = std::max(1, static_cast<int>(std::lround((to_m - from_m) / kBottomPatch_m)));
  const double rear_wheel_m = -0.5 * (track.road_wheels - 1) * track.road_wheel_pitch_m;
  for (int i = 0; i < count; ++i) {
    ContactPatch patch;
    patch.length_m = (to_m - from_m) / count;
    patch.width_m = track.width_m;
    const double x_m = from_m + (i + 0.5) * patch.length_m;
    patch.p_B_m = track.center_B_m + Vec3(x_m, 0, -track.radius_m);
    if (under_wheels) {
      patch.wheel_pitch_m = track.road_wheel_pitch_m;
      patch.past_wheel_m = -std::remainder(x_m - rear_wheel_m, track.road_wheel_pitch_m);
    }
    patches->push_back(patch);
  }
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
  const double end_m = 0.5 * track.wheelbase_m;
  const double wheels_end_m = 0.5 * track.road_wheels * track.road_wheel_pitch_m;
  AddBottom(track, -end_m, -wheels_end_m, false, &patches);
  AddBottom(track, -wheels_end_m, wheels_end_m, true, &patches);
  AddBottom(track, wheels_end_m, end_m, false, &patches);
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
