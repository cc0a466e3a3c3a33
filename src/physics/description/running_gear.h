#pragma once

#include <vector>

#include "core/types/ground_tools.h"

/// The shapes of tracks and wheels, as patches that press on the ground and as the path of the
/// shoes.

namespace tera {

/// A track around a sprocket and an idler of one size.
///
/// Frames  B link frame; the track runs in planes parallel to B's x-z plane.
struct TrackShape {
  Vec3 center_B_m = Vec3::Zero();  ///< middle between sprocket and idler axles
  double wheelbase_m = 0;          ///< sprocket to idler
  double radius_m = 0;             ///< outside of the shoes around sprocket and idler
  double width_m = 0;
  int road_wheels = 0;            ///< on the bottom run, as many before the middle as behind
  double road_wheel_pitch_m = 0;  ///< between their axles
};

/// Wheels that turn together, such as those of one side of a skid-steer machine.
struct WheelSetShape {
  std::vector<Vec3> axles_B_m;
  double radius_m = 0;
  double width_m = 0;
};

/// Patches of the bottom run from rear to front, with the noses that rise around sprocket and
/// idler, by which a track climbs and levels out. Under the road wheels, half a pitch before the
/// first to half a pitch behind the last, the pressure has peaks.
std::vector<ContactPatch> TrackPatches(const TrackShape& track);

/// Patches of the lower part of every wheel, each tangent to the tyre.
std::vector<ContactPatch> WheelPatches(const WheelSetShape& wheels);

/// Closed path along the outer face of the shoes in the direction in which they move when the
/// track drives forward: backwards along the bottom, up around the rear, forwards along the top.
std::vector<Vec3> TrackPath(const TrackShape& track);

}  // namespace tera
