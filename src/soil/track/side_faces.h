#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/ground_tools.h"

namespace tera {

/// The vertical faces on both sides of a track, on which it bears when the machine leans.
///
/// Frames  B the frame of the gear's link; W.
/// Model   On both sides of each patch, a strip reaches from its lower edge to the height of the
///         axles. The ends of its shoes travel with the patch. Soil meets a steep face as a wall
///         (passive pressure in GearContact). From the downward component `kFrom` on, a share of
///         the face touches, from the lower edge up. It bears and presses soil as a plate; at
///         `kWholly` all of it touches. These are the sines of a lean of 20 and 30 deg. A machine
///         on both tracks leans less.
/// Omits   Upper half of the side of a track, gaps between shoes and frame, sides of wheels,
///         resistance of soil that the face newly touches as the machine leans further.
struct SideFaces {
  static constexpr double kFrom = 0.34, kWholly = 0.5;

  /// `gear` with side faces appended to its patches. Wheels have no side faces.
  static RunningGear AddedTo(const RunningGear& gear);
  static bool IsOne(const ContactPatch& patch) { return std::abs(patch.outward_B.y()) > 0.5; }
  /// Share of a face that touches, 0 to 1. `down` is the downward component of its outward normal.
  static double Bearing(double down) {
    return std::clamp((down - kFrom) / (kWholly - kFrom), 0.0, 1.0);
  }
  /// Middle of the touching part of a face, from the middle of the face along across_W of
  /// Footprint.
  static double Middle_m(const ContactPatch& face, double touching) {
    return -0.5 * face.outward_B.y() * (1 - touching) * face.width_m;
  }
};

}  // namespace tera
