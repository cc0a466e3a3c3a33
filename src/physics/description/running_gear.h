#pragma once

#include <vector>

#include "core/types/ground_tools.h"

/// Shapes of tracks and wheels, as contact patches on the ground and as the path of the shoes.

namespace tera {

/// A track around a sprocket and an idler of equal size.
///
/// Frames  B link frame; the track runs in planes parallel to B's x-z plane.
struct TrackShape {
  Vec3 center_B_m = Vec3::Zero();  ///< middle between sprocket and idler axles
  double wheelbase_m = 0;          ///< sprocket to idler
  double radius_m = 0;             ///< outside of the shoes around sprocket and idler
  double width_m = 0;
  int road_wheels = 0;            ///< on the bottom run, placed symmetrically about its middle
  double road_wheel_pitch_m = 0;  ///< between their axles
};

/// Wheels that turn together, such as the wheels on one side of a skid-steer machine.
struct WheelSetShape {
  std::vector<Vec3> axles_B_m;
  double radius_m = 0;
  double width_m = 0;
};

/// Patches of a track from rear to front: the rear nose, the bottom run and the front nose. The
/// noses rise around sprocket and idler, and let a track climb and level out. Patches of the bottom
/// run within half a pitch of a road wheel carry their position to it, for the pressure peaks
/// there.
std::vector<ContactPatch> TrackPatches(const TrackShape& track);

/// Patches of the lower part of every wheel, each tangent to the tyre.
std::vector<ContactPatch> WheelPatches(const WheelSetShape& wheels);

/// Closed path along the outer face of the shoes, in their direction of motion when the track
/// drives forward. It runs backwards along the bottom, up around the rear, forwards along the top.
std::vector<Vec3> TrackPath(const TrackShape& track);

}  // namespace tera
