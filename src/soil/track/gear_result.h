#pragma once

#include <algorithm>

#include "core/motion.h"

namespace tera {

/// What the parts of a gear on the ground do together.
struct GearSum {
  Wrench wrench;          ///< about the link's origin
  double traction_n = 0;  ///< shear along the machine's forward travel
  double sinkage_m = 0;   ///< of the lowest
  double grip_n = 0;      ///< shear strength of the ground below
  double weight_n = 0;    ///< normal forces
  double forward_w = 0;   ///< times the speed ahead at each
  double contact_m = 0;   ///< length of the ground under it

  void Add(const GearSum& other) {
    wrench.force_W_n += other.wrench.force_W_n;
    wrench.torque_W_nm += other.wrench.torque_W_nm;
    traction_n += other.traction_n;
    sinkage_m = std::max(sinkage_m, other.sinkage_m);
    grip_n += other.grip_n;
    weight_n += other.weight_n;
    forward_w += other.forward_w;
    contact_m += other.contact_m;
  }
};

}  // namespace tera
