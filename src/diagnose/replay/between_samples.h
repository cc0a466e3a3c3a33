#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"

namespace tera {

/// Linear interpolation at a time: the two neighbouring samples and the share of the way between
/// them. Outside the samples, the nearest one holds (a is b there).
struct BetweenSamples {
  std::size_t a = 0, b = 0;
  double s = 0;

  /// The times must ascend, with at least one.
  BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns);
  double Of(const std::vector<double>& values) const;
};

}  // namespace tera
