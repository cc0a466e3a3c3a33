#include "diagnose/statistics/tests/circular_shifts.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace tera {
namespace {

std::vector<Segment> EqualBlocks(std::size_t size, std::size_t length) {
  const std::size_t count = length == 0 ? 1 : std::max<std::size_t>(size / length, 1);
  std::vector<Segment> blocks(count);
  for (std::size_t b = 0; b < count; ++b) {
    blocks[b] = {b * size / count, (b + 1) * size / count};
  }
  return blocks;
}

}  // namespace

CircularShifts::CircularShifts(std::size_t size, std::size_t least, std::size_t most,
                               std::size_t block, const Stream& stream) {
  TERA_CHECK(least > 0);
  if (block > 0) block = std::max(block, 4 * least);
  blocks_ = EqualBlocks(size, block);
  if (blocks_.front().size() < 3 * least) return;
  if (blocks_.size() == 1) {
    const std::size_t room = size - 2 * least;
    const std::size_t count = std::min(most, room / least);
    const double stride =
        static_cast<double>(room) / static_cast<double>(std::max<std::size_t>(count, 1));
    const double u = stream.Uniform(0);
    for (std::size_t k = 0; k < count; ++k) {
      offset_.push_back({least + static_cast<std::size_t>((static_cast<double>(k) + u) * stride)});
    }
    return;
  }
  // No more shifts than are nearly independent: room / least in each block.
  double independent = 1;
  for (const Segment& block : blocks_) {
    independent *= static_cast<double>(block.size() - 2 * least) / static_cast<double>(least);
  }
  most = std::min(most, static_cast<std::size_t>(std::min(independent, 1e6)));
  for (std::size_t k = 0; k < most; ++k) {
    std::vector<std::size_t> offsets(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const double room = static_cast<double>(blocks_[b].size() - 2 * least);
      offsets[b] =
          least + static_cast<std::size_t>(stream.Uniform(k, static_cast<std::uint32_t>(b)) * room);
    }
    offset_.push_back(std::move(offsets));
  }
}

ShiftComparison CompareWithShifts(double observed, std::vector<double> shifted) {
  ShiftComparison out{observed, 1, 1, shifted.size()};
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
