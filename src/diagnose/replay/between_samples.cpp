#include "diagnose/replay/between_samples.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {

BetweenSamples::BetweenSamples(const std::vector<TimeNs>& t_ns, TimeNs at_ns) {
  TERA_CHECK(!t_ns.empty(), at_ns);
  const auto next = std::lower_bound(t_ns.begin(), t_ns.end(), at_ns);
  if (next == t_ns.begin()) return;
  a = static_cast<std::size_t>(next - t_ns.begin()) - 1;
  b = next == t_ns.end() ? a : a + 1;
  if (b > a) s = static_cast<double>(at_ns - t_ns[a]) / static_cast<double>(t_ns[b] - t_ns[a]);
}

double BetweenSamples::Of(const std::vector<double>& values) const {
  return std::lerp(values[a], values[b], s);
}

}  // namespace tera
