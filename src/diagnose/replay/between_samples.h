#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"

namespace tera {

/// Linear interpolation at a time: the two samples around it and the share of the way between them.
/// Before the first and after the last sample that sample's value holds (a is b there).
struct BetweenSamples {
  std::size_t a = 0, b = 0;
  double s = 0;

  /// The times must rise; there must be at least one.
  BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns);
  double Of(const std::vector<double>& values) const;
};

}  // namespace tera
