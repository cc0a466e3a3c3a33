#include "soil/track/side_faces.h"

#include <algorithm>

namespace tera {
namespace {

/// The strip beside `patch`; `side` is 1 for left, -1 for right.
ContactPatch StripBeside(const ContactPatch& patch, double side, double radius_m) {
  const double down = -patch.outward_B.z();
  const double height_m = radius_m * down;
  ContactPatch strip;
  strip.outward_B = side * Vec3::UnitY();
  strip.p_B_m =
      patch.p_B_m + 0.5 * patch.width_m * strip.outward_B + 0.5 * height_m * Vec3::UnitZ();
  strip.length_m = patch.length_m * down;
  strip.width_m = height_m;
  return strip;
}

/// A track has a flat run: two successive patches with the same normal.
bool IsTrack(const RunningGear& gear) {
  return std::any_of(gear.patches.begin() + 1, gear.patches.end(), [&](const ContactPatch& patch) {
    return patch.outward_B == (&patch - 1)->outward_B;
  });
}

}  // namespace

RunningGear SideFaces::AddedTo(const RunningGear& gear) {
  RunningGear with = gear;
  if (gear.patches.size() < 2 || !IsTrack(gear)) return with;
  for (const double side : {1.0, -1.0}) {
    for (const ContactPatch& patch : gear.patches) {
      with.patches.push_back(StripBeside(patch, side, gear.drive_radius_m));
    }
  }
  return with;
}

}  // namespace tera
