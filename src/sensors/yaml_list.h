#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "core/motion.h"

/// Lists as a sensor.yaml has them, "[1, 2, 3]", in units of `unit`.

namespace tera {

inline std::string YamlList(std::vector<double> values, double unit = 1.0) {
  for (double& v : values) v /= unit;
  return fmt::format("[{:.12g}]", fmt::join(values, ", "));
}

inline std::string YamlList(const Vec3& v, double unit = 1.0) {
  return YamlList(std::vector<double>{v.x(), v.y(), v.z()}, unit);
}

}  // namespace tera
