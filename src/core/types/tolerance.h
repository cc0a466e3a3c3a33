#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/types/effects.h"

namespace tera {

/// How far one number of a mechanism may be from what a scenario says and still be as expected.
struct Tolerance {
  std::string target;  ///< as in YAML: "boom", "imu_boom", "encoders/boom", "base"
  const Mechanism* mechanism = nullptr;
  std::size_t parameter = 0;  ///< among the mechanism's
  double half_width = 0;      ///< 95 % of what is as expected lies so near; in the parameter's unit
};

using Tolerances = std::vector<Tolerance>;

}  // namespace tera
