#pragma once

#include <vector>

#include "core/motion.h"
#include "core/time.h"

namespace tera {

/// One measured return, in the sensor's frame S at its own time.
struct RangePoint {
  Vec3 p_S_m = Vec3::Zero();
  TimeNs since_ns = 0;  ///< after the scan's t_ns
  double sigma_m = 0;   ///< of its noise along the ray, as the sensor's model has it
};

struct RangeScan {
  TimeNs t_ns = 0;  ///< as written on it
  std::vector<RangePoint> points;
};

}  // namespace tera
