#include "diagnose/perception/scans/scan_split.h"

#include <algorithm>
#include <set>

#include "core/check.h"

namespace tera {
namespace {

constexpr TimeNs kShortestBlock_ns = 1'000'000'000;
constexpr TimeNs kMostBlocks = 40;
constexpr std::size_t kRound = 10;

/// Parts of ten blocks in a row, in an order of their own.
std::array<Part, kRound> OneRound(const Stream& stream, std::size_t round) {
  using enum Part;
  std::array<Part, kRound> parts = {kTrain,  kTrain,  kTrain, kTrain, kSelect,
                                    kSelect, kSelect, kFinal, kFinal, kFinal};
  for (std::size_t i = kRound - 1; i > 0; --i) {
    const double draw = stream.Uniform(round * kRound + i);
    std::swap(parts[i], parts[static_cast<std::size_t>(draw * static_cast<double>(i + 1))]);
  }
  return parts;
}

}  // namespace

ScanSplit SplitScans(const std::vector<RangeScan>& scans, const Stream& stream) {
  std::vector<TimeNs> t_ns;
  for (const RangeScan& scan : scans) t_ns.push_back(scan.t_ns);
  return SplitTimes(t_ns, stream);
}

ScanSplit SplitTimes(const std::vector<TimeNs>& t_ns, const Stream& stream) {
  ScanSplit split;
  if (t_ns.empty()) return split;
  const TimeNs first_ns = t_ns.front();
  const TimeNs length_ns = std::max(kShortestBlock_ns, (t_ns.back() - first_ns) / kMostBlocks + 1);
  std::set<std::size_t> used;
  TimeNs last = -1;
  for (const TimeNs t : t_ns) {
    const TimeNs at = (t - first_ns) / length_ns;
    // Numbered without the empty ones, so that shares are of blocks that have scans.
    if (at != last) used.insert(used.size());
    last = at;
    split.block.push_back(used.size() - 1);
    const std::size_t block = split.block.back();
    split.part.push_back(OneRound(stream, block / kRound)[block % kRound]);
  }
  split.blocks = used.size();
  return split;
}

std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const std::vector<std::vector<bool>>& left_out) {
  TERA_CHECK(left_out.empty() || left_out.size() == scans.size(), left_out.size());
  std::vector<ScanPoints> chosen;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    if (std::find(parts.begin(), parts.end(), split.part[s]) == parts.end()) continue;
    ScanPoints of_scan{s, {}};
    const std::size_t count = scans[s].points.size();
    const std::size_t stride = count / most + 1;
    for (std::size_t p = s % stride; p < count; p += stride) {
      if (left_out.empty() || !left_out[s][p]) of_scan.points.push_back(p);
    }
    chosen.push_back(std::move(of_scan));
  }
  return chosen;
}

}  // namespace tera
