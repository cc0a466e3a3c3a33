#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/ground_tools.h"

namespace tera {

/// The upright faces at both sides of a track, on which it bears when the machine leans.
///
/// Frames  B the frame of the gear's link; W.
/// Model   Beside each patch, inside and outside, a strip from its lower edge up to the
///         axles' height, whose shoes' ends travel with the patch. While the face is steep, what
///         stands beside it meets it as a wall does (GearContact's passive pressure); from `kFrom`
///         on a share of it, from the lower edge up, touches: it bears and presses soil as a plate,
///         wholly from `kWholly`. These are the sines of the machine's lean, 20 and 30 deg: a
///         machine that stands on both tracks leans by less.
/// Omits   the upper half of a track's side, the gaps between shoes and frame, wheels' sides; that
///         newly touched soil resists as the machine leans further.
struct SideFaces {
  static constexpr double kFrom = 0.34, kWholly = 0.5;

  /// `gear` with its side faces behind its own patches; of wheels, `gear` as it is.
  static RunningGear AddedTo(const RunningGear& gear);
  static bool IsOne(const ContactPatch& patch) { return std::abs(patch.outward_B.y()) > 0.5; }
  /// Share that touches, 0 to 1, of a face whose outward normal's part downwards is `down`.
  static double Bearing(double down) {
    return std::clamp((down - kFrom) / (kWholly - kFrom), 0.0, 1.0);
  }
  /// Middle of the touching part of a face, along its Footprint's across_W from the face's own
  /// middle.
  static double Middle_m(const ContactPatch& face, double touching) {
    return -0.5 * face.outward_B.y() * (1 - touching) * face.width_m;
  }
};

}  // namespace tera
