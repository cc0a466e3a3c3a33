#pragma once

#include <cstddef>
#include <vector>

#include "core/time.h"

namespace tera {

/// The two samples about a time, and how far between them it is. Values are straight in between,
/// and beyond the first and the last as these: a is b there.
struct BetweenSamples {
  std::size_t a = 0, b = 0;
  double s = 0;

  /// Times rise; one at least.
  BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns);
  double Of(const std::vector<double>& values) const;
};

}  // namespace tera
