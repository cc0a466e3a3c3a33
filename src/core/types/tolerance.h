#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/types/effects.h"

namespace tera {

/// Allowed deviation of one mechanism parameter from its value in the scenario.
struct Tolerance {
  std::string target;  ///< name in YAML: "boom", "imu_boom", "encoders/boom", "base"
  const Mechanism* mechanism = nullptr;
  std::size_t parameter = 0;  ///< index among the mechanism's parameters
  double half_width = 0;      ///< 95 % bound, in the parameter's unit
};

using Tolerances = std::vector<Tolerance>;

}  // namespace tera
