#pragma once

#include "core/types/ground_tools.h"

namespace tera {

/// A patch of running gear where it stands.
///
/// Frames  W.
struct Footprint {
  Footprint(const ContactPatch& patch, const Pose& X_WB)
      : p_W_m(X_WB * patch.p_B_m),
        n_W(X_WB.linear() * patch.outward_B),
        along_W(X_WB.linear() * patch.travel_B),
        across_W(n_W.cross(along_W)) {}

  Vec3 p_W_m;     ///< its middle
  Vec3 n_W;       ///< outward, into the ground
  Vec3 along_W;   ///< along the shoes' travel when the gear drives forward
  Vec3 across_W;  ///< right-handed with n_W and along_W
};

}  // namespace tera
