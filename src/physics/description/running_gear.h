#pragma once

#include <vector>

#include "core/types/ground_tools.h"

/// Shapes of tracks and wheels: contact patches on the ground, and the path of the shoes.

namespace tera {

/// A track around a sprocket and an idler of equal size.
///
/// Frames  B link frame; the track runs in planes parallel to B's x-z plane.
struct TrackShape {
  Vec3 center_B_m = Vec3::Zero();  ///< middle between sprocket and idler axles
  double wheelbase_m = 0;          ///< from sprocket to idler
  double radius_m = 0;             ///< to the outside of the shoes around sprocket and idler
  double width_m = 0;
  int road_wheels = 0;            ///< number on the bottom run, symmetric about its middle
  double road_wheel_pitch_m = 0;  ///< between axles
};

/// Wheels that turn together, such as the wheels on one side of a skid-steer machine.
struct WheelSetShape {
  std::vector<Vec3> axles_B_m;
  double radius_m = 0;
  double width_m = 0;
};

/// Patches of a track from rear to front: rear nose, bottom run, front nose. The noses rise around
/// sprocket and idler, so that a track can climb and level out. Patches within half a pitch of a
/// road wheel store their position relative to it, for the pressure peaks.
std::vector<ContactPatch> TrackPatches(const TrackShape& track);

/// Patches of the lower part of every wheel, each tangent to the tyre.
std::vector<ContactPatch> WheelPatches(const WheelSetShape& wheels);

/// Closed path along the outer face of the shoes, in their direction of motion when the track
/// drives forward: backwards along the bottom, up around the rear, forwards along the top.
std::vector<Vec3> TrackPath(const TrackShape& track);

}  // namespace tera
