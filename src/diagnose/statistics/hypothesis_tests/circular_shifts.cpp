#include "diagnose/statistics/hypothesis_tests/circular_shifts.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {

std::vector<std::size_t> CircularShifts(std::size_t size, std::size_t least, std::size_t most,
                                        const Stream& stream) {
  TERA_CHECK(least > 0);
  std::vector<std::size_t> offsets;
  if (size < 3 * least) return offsets;
  const std::size_t room = size - 2 * least;
  const std::size_t count = std::min(most, room / least);
  const double stride =
      static_cast<double>(room) / static_cast<double>(std::max<std::size_t>(count, 1));
  const double u = stream.Uniform(0);
  for (std::size_t k = 0; k < count; ++k) {
    offsets.push_back(least + static_cast<std::size_t>((static_cast<double>(k) + u) * stride));
  }
  return offsets;
}

ShiftComparison CompareWithShifts(double observed, std::vector<double> shifted) {
  ShiftComparison out;
  if (shifted.empty()) return out;
  const auto count = static_cast<double>(shifted.size());
  const auto beyond = static_cast<double>(
      std::count_if(shifted.begin(), shifted.end(), [&](double s) { return s >= observed; }));
  out.p = out.p_tail = (1 + beyond) / (1 + count);
  if (shifted.size() < 50 || beyond >= 10) return out;

  std::sort(shifted.begin(), shifted.end(), std::greater<>());
  const std::size_t tail = shifted.size() / 5;
  const double start = shifted[tail];
  double excess = 0;
  for (std::size_t k = 0; k < tail; ++k) excess += (shifted[k] - start) / static_cast<double>(tail);
  if (!(excess > 0) || observed <= start) return out;
  const double share = static_cast<double>(tail) / count;
  out.p_tail = std::min(out.p, share * std::exp(-(observed - start) / excess));
  return out;
}

}  // namespace tera
