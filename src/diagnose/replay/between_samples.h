#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"

namespace tera {

/// Linear interpolation between the two samples around a time: value = (1 - s) a + s b. Outside the
/// samples the nearest one holds (s = 0).
struct BetweenSamples {
  std::size_t a = 0, b = 0;
  double s = 0;

  /// `t_ns` ascends and has at least one entry.
  BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns);
  double Of(const std::vector<double>& values) const;
};

}  // namespace tera
