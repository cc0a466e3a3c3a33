#pragma once

#include <optional>

#include "physics/description/machine.h"

namespace tera {

/// Boom, arm and bucket as a planar arm with three joints on a slewing base.
///
/// Frames  V is the vertical plane of the arm: origin on the slew axis at the height of the slewing
///         link's frame, r outward, z up. Pitch is measured from the horizontal, positive up.
/// Model   two-link inverse kinematics for boom and arm (elbow up). The bucket makes up the
///         remaining pitch.
/// Omits   boom swing (taken as zero) and the tilt of the slewing link.
/// Source  two-link arm by the law of cosines: Craig 2005, "Introduction to robotics", section 4.4.
class PlanarArm {
 public:
  struct Joints {
    int slew = -1, boom = -1, arm = -1, bucket = -1;
  };
  /// Position and pitch of the bucket's tip frame in V.
  struct Tip {
    double r_m = 0, z_m = 0, pitch_rad = 0;
  };
  struct Angles {
    double boom_rad = 0, arm_rad = 0, bucket_rad = 0;
  };

  /// `tip_frame` is the index of one of the model's frames on the bucket's link.
  PlanarArm(const MachineModel& model, const Joints& joints, int tip_frame);

  /// Joint angles for a tip pose; empty if it is out of reach. Ignores joint limits.
  std::optional<Angles> Inverse(const Tip& tip) const;
  Tip Forward(const Angles& angles) const;
  double bucket_length_m() const { return bucket_length_m_; }  ///< from its pin to the tip

 private:
  Vec2 boom_foot_m_;  ///< position of the boom's joint in V
  double boom_length_m_, arm_length_m_, bucket_length_m_;
  double bucket_offset_rad_;  ///< pitch of the tip direction relative to the arm at q = 0
};

}  // namespace tera
