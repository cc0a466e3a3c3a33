#include "diagnose/statistics/tests/block_bootstrap.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {

std::vector<Segment> CutIntoBlocks(std::size_t size, std::size_t length) {
  TERA_CHECK(length > 0);
  const std::size_t count = std::max<std::size_t>((size + length / 2) / length, 1);
  std::vector<Segment> blocks(count);
  for (std::size_t b = 0; b < count; ++b) blocks[b] = {b * length, (b + 1) * length};
  blocks.back().end = size;
  return blocks;
}

std::vector<int> DrawBlocks(std::size_t blocks, std::size_t replicate, const Stream& stream) {
  std::vector<int> drawn(blocks, 0);
  for (std::size_t k = 0; k < blocks; ++k) {
    const double u = stream.Uniform(replicate, static_cast<std::uint32_t>(k));
    ++drawn[std::min(static_cast<std::size_t>(u * static_cast<double>(blocks)), blocks - 1)];
  }
  return drawn;
}

Interval BootstrapRatio(const std::vector<double>& numerator,
                        const std::vector<double>& denominator, double confidence,
                        std::size_t replicates, const Stream& stream) {
  TERA_CHECK(numerator.size() == denominator.size() && !numerator.empty(), numerator.size());
  std::vector<double> ratio;
  for (std::size_t r = 0; r < replicates; ++r) {
    const std::vector<int> drawn = DrawBlocks(numerator.size(), r, stream);
    double top = 0, bottom = 0;
    for (std::size_t b = 0; b < drawn.size(); ++b) {
      top += drawn[b] * numerator[b];
      bottom += drawn[b] * denominator[b];
    }
    if (bottom != 0) ratio.push_back(top / bottom);
  }
  TERA_CHECK(!ratio.empty());
  return {Quantile(ratio, (1 - confidence) / 2), Quantile(ratio, (1 + confidence) / 2)};
}

}  // namespace tera
