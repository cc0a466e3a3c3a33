#include "diagnose/statistics/hypothesis_tests/block_bootstrap.h"

#include <algorithm>

#include "core/check.h"

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

}  // namespace tera
