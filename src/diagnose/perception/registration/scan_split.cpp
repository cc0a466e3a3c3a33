#include "diagnose/perception/registration/scan_split.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tera {
namespace {

constexpr TimeNs kShortestBlock_ns = 1'000'000'000;
constexpr TimeNs kMostBlocks = 40;  ///< of a recording that is longer than so many shortest ones
/// Blocks of a round, among which the shares of the parts are exact.
constexpr std::size_t kBlocksOfRound = 10;

/// Parts of ten blocks in a row, in an order of their own.
std::array<Part, kBlocksOfRound> PartsOfRound(const Stream& stream, std::size_t round) {
  using enum Part;
  std::array<Part, kBlocksOfRound> parts = {kTrain,  kTrain,  kTrain, kTrain, kSelect,
                                            kSelect, kSelect, kFinal, kFinal, kFinal};
  for (std::size_t i = kBlocksOfRound - 1; i > 0; --i) {
    const double draw = stream.Uniform(round * kBlocksOfRound + i);
    std::swap(parts[i], parts[static_cast<std::size_t>(draw * static_cast<double>(i + 1))]);
  }
  return parts;
}

}  // namespace

ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream) {
  ScanSplit split;
  if (t_ns.empty()) return split;
  const TimeNs first_ns = t_ns.front();
  const TimeNs length_ns = std::max(kShortestBlock_ns, (t_ns.back() - first_ns) / kMostBlocks + 1);
  TimeNs last = -1;
  for (const TimeNs t : t_ns) {
    const TimeNs at = (t - first_ns) / length_ns;
    // Counted without the empty ones, so that shares are of blocks that have scans.
    if (at != last) ++split.blocks;
    last = at;
    const std::size_t block = split.blocks - 1;
    split.block.push_back(block);
    split.part.push_back(PartsOfRound(stream, block / kBlocksOfRound)[block % kBlocksOfRound]);
  }
  return split;
}

}  // namespace tera
