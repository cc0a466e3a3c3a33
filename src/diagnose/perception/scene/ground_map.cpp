#include "diagnose/perception/scene/ground_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/units.h"
#include "diagnose/perception/scene/height_differences.h"
#include "diagnose/perception/scene/moderated_t_test.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

/// Least standard deviation of a cell's height. No number of scans makes it smaller.
constexpr double kLeastSigma_m = 0.01;
constexpr double kLeastDifference_m = 0.05;  ///< least height difference of a cell in a region
constexpr double kFalseShare = 0.01;         ///< false discovery rate among cells
constexpr double kConfirmedRegionP = 0.01;   ///< level of confirmation, over all regions
constexpr double kLeastAgain = 0.5;  ///< share of a region's height, on FINAL and in its intervals
constexpr std::size_t kFewestBlocksOfCell = 3, kFewestPoints = 6;  ///< minimum per judged cell
constexpr std::size_t kFewestCells = 4;                            ///< minimum per region
constexpr int kReach = 2;              ///< distance in cells at which cells are linked
constexpr double kWall_m = 0.3;        ///< height range within a cell that indicates a wall
constexpr double kWallShare = 0.35;    ///< share of cells with walls that indicates an object
constexpr double kSteepestCone = 1.7;  ///< slope of the steepest cone of soil: 60 deg
constexpr double kWindows = 3;         ///< the recording and its halves

/// The prior is eight blocks that agree within 2 cm. The prior matters where few blocks see a cell,
/// because the scatter of few blocks is uncertain.
constexpr ModeratedTTest kHeightTest{
    .prior_blocks = 8, .prior_scatter = 0.02, .least_sigma = kLeastSigma_m};

using Blocks = std::map<std::size_t, std::vector<double>>;
using Cells = std::map<CellIndex, Blocks>;

/// p-value of a mean at least this far from 0, on its own side.
double OneSidedP(ModeratedTTest::Mean of) {
  of.mean = std::abs(of.mean);
  return kHeightTest.PFrom(of);
}

struct CellDifference {
  double median_m;
  double p;  ///< of such a difference, either way, by chance
};

/// Difference of a cell in blocks `first` to `last`, without `last`. Returns nothing with too few
/// blocks or points.
std::optional<CellDifference> DifferenceOf(const Blocks& blocks, double first, double last) {
  std::vector<double> medians;
  std::size_t points = 0;
  for (const auto& [block, values] : blocks) {
    if (static_cast<double>(block) < first || static_cast<double>(block) >= last) continue;
    medians.push_back(Median(values));
    points += values.size();
  }
  if (medians.size() < kFewestBlocksOfCell || points < kFewestPoints) return std::nullopt;
  return CellDifference{Median(medians), 2 * OneSidedP(kHeightTest.MeanOf(medians))};
}

/// True if at least half of a cell's blocks show a wall.
bool HasWall(const Blocks& blocks) {
  std::size_t steep = 0, known = 0;
  for (const auto& [block, values] : blocks) {
    if (values.size() < 2) continue;
    ++known;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    steep += *high - *low > kWall_m ? 1 : 0;
  }
  return known > 0 && 2 * steep >= known;
}

/// Cells that differ in blocks `first` to `last`, without `last` (Benjamini and Hochberg).
std::map<CellIndex, CellDifference> Differing(const Cells& cells, double first, double last) {
  std::vector<std::pair<double, CellIndex>> by_p;
  std::map<CellIndex, CellDifference> judged;
  for (const auto& [place, blocks] : cells) {
    const auto one = DifferenceOf(blocks, first, last);
    if (!one) continue;
    judged[place] = *one;
    by_p.emplace_back(one->p, place);
  }
  std::sort(by_p.begin(), by_p.end());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < by_p.size(); ++k) {
    const double level =
        kFalseShare / kWindows * static_cast<double>(k + 1) / static_cast<double>(by_p.size());
    if (by_p[k].first <= level) kept = k + 1;
  }
  std::map<CellIndex, CellDifference> differing;
  for (std::size_t k = 0; k < kept; ++k) {
    const CellDifference& one = judged[by_p[k].second];
    if (std::abs(one.median_m) >= kLeastDifference_m) differing[by_p[k].second] = one;
  }
  return differing;
}

/// A cell and those up to `reach` cells away, row by row.
std::vector<CellIndex> Around(const CellIndex& place, int reach) {
  std::vector<CellIndex> cells;
  for (int a = -reach; a <= reach; ++a) {
    for (int b = -reach; b <= reach; ++b) cells.emplace_back(place.first + a, place.second + b);
  }
  return cells;
}

/// Connected cells of one sign.
std::vector<std::vector<CellIndex>> Clusters(const std::map<CellIndex, CellDifference>& cells) {
  std::vector<std::vector<CellIndex>> clusters;
  std::set<CellIndex> taken;
  for (const auto& [start, first] : cells) {
    if (taken.contains(start)) continue;
    std::vector<CellIndex> cluster = {start};
    taken.insert(start);
    for (std::size_t next = 0; next < cluster.size(); ++next) {
      for (const CellIndex& near : Around(cluster[next], kReach)) {
        const auto at = cells.find(near);
        if (at == cells.end() || taken.contains(near)) continue;
        if ((at->second.median_m > 0) != (first.median_m > 0)) continue;
        taken.insert(near);
        cluster.push_back(near);
      }
    }
    if (cluster.size() >= kFewestCells) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

/// Copies values into cells that no ray hit, from the nearest cell within reach, if that cell
/// belongs to a region.
void FillGaps(GroundMap* map) {
  std::map<CellIndex, GroundCell> filled;
  for (const auto& [place, cell] : map->cells) {
    if (cell.region < 0) continue;
    for (const CellIndex& near : Around(place, kReach)) {
      if (map->cells.contains(near) || filled.contains(near)) continue;
      const GroundCell* nearest = nullptr;
      int distance = std::numeric_limits<int>::max();
      for (const CellIndex& other : Around(near, kReach)) {
        const auto at = map->cells.find(other);
        const int a = other.first - near.first, b = other.second - near.second;
        if (at == map->cells.end() || a * a + b * b >= distance) continue;
        distance = a * a + b * b;
        nearest = &at->second;
      }
      if (nearest == nullptr || nearest->region < 0) continue;
      filled[near] = *nearest;
    }
  }
  map->cells.insert(filled.begin(), filled.end());
}

void Measure(const GroundMap& map, int index, GroundRegion* region) {
  const double square_m2 = map.cell_m * map.cell_m;
  region->low_W_m.setConstant(std::numeric_limits<double>::infinity());
  region->high_W_m = -region->low_W_m;
  region->lowest_m = std::numeric_limits<double>::infinity();
  region->highest_m = -region->lowest_m;
  for (const auto& [place, cell] : map.cells) {
    if (cell.region != index) continue;
    const Vec2 corner_m = map.cell_m * Vec2(place.first, place.second);
    region->area_m2 += square_m2;
    region->volume_m3 += square_m2 * cell.above_m;
    region->centre_W_m += square_m2 * (corner_m + Vec2::Constant(0.5 * map.cell_m));
    region->low_W_m = region->low_W_m.cwiseMin(corner_m);
    region->high_W_m = region->high_W_m.cwiseMax(corner_m + Vec2::Constant(map.cell_m));
    region->lowest_m = std::min(region->lowest_m, cell.above_m);
    region->highest_m = std::max(region->highest_m, cell.above_m);
  }
  region->centre_W_m /= region->area_m2;
  region->mean_m = region->volume_m3 / region->area_m2;
}

/// True if soil cannot have this shape: it has walls, or it is higher than the steepest cone of
/// soil on its area.
bool IsObject(const GroundRegion& region) {
  if (region.mean_m < 0) return false;
  return region.upright || region.highest_m > kSteepestCone * std::sqrt(region.area_m2 / kPi);
}

bool IsNearRegion(const GroundMap& map, const CellIndex& place) {
  const std::vector<CellIndex> near = Around(place, 1);
  return std::any_of(near.begin(), near.end(), [&](const CellIndex& one) {
    const auto at = map.cells.find(one);
    return at != map.cells.end() && at->second.region >= 0;
  });
}

Blocks BlocksOf(const std::vector<HeightDifference>& differences, const ScanSplit& split,
                const GroundMap& map, int index) {
  Blocks blocks;
  for (const HeightDifference& s : differences) {
    const auto at = map.cells.find(s.cell);
    if (at == map.cells.end() || at->second.region != index) continue;
    blocks[split.block[s.scan]].push_back(s.above_m);
  }
  return blocks;
}

/// Times at which a region differs; none if that is always.
std::vector<std::pair<double, double>> TimesOf(const RangeSource& source, const ScanSplit& split,
                                               const Blocks& blocks, const GroundRegion& region) {
  std::vector<double> medians;
  for (const auto& [block, values] : blocks) medians.push_back(Median(values));
  const double full_m = Quantile(medians, region.mean_m > 0 ? 0.9 : 0.1);
  std::map<std::size_t, bool> differs;
  for (const auto& [block, values] : blocks) {
    differs[block] = Median(values) / full_m > kLeastAgain;
  }
  return IntervalsOf(source, split, differs);
}

/// Sets the region's errors on FINAL. Sets its p-value if FINAL shows at least half its height.
void Confirm(const std::vector<HeightDifference>& final_differences, const ScanSplit& split,
             const GroundMap& map, int index, GroundRegion* region) {
  std::vector<double> medians;
  double before = 0, after = 0, count = 0;
  for (const auto& [block, values] : BlocksOf(final_differences, split, map, index)) {
    medians.push_back(Median(values));
  }
  for (const HeightDifference& s : final_differences) {
    const auto at = map.cells.find(s.cell);
    if (at == map.cells.end() || at->second.region != index) continue;
    before += s.above_m * s.above_m;
    after += std::pow(s.above_m - at->second.above_m, 2);
    count += 1;
  }
  if (count > 0) {
    region->rmse_before_m = std::sqrt(before / count);
    region->rmse_after_m = std::sqrt(after / count);
  }
  if (medians.size() < kFewestBlocksOfCell) return;
  const ModeratedTTest::Mean of = kHeightTest.MeanOf(medians);
  if (of.mean / region->mean_m < kLeastAgain) return;
  region->p_confirmed = OneSidedP(of);
}

/// Clusters of cells that differ in the recording or in one of its halves. The map gets all judged
/// cells. Each returned region has only `p_chosen` and `upright` set, where `upright` means walls.
std::vector<GroundRegion> FindRegions(const Cells& cells, const ScanSplit& split, GroundMap* map) {
  const auto blocks = static_cast<double>(split.blocks);
  std::map<CellIndex, CellDifference> differing = Differing(cells, 0, blocks);
  for (const auto& part : {Differing(cells, 0, blocks / 2), Differing(cells, blocks / 2, blocks)}) {
    differing.insert(part.begin(), part.end());
  }
  for (const auto& [place, values] : cells) {
    const auto own = differing.find(place);
    const auto judged =
        own != differing.end() ? std::optional(own->second) : DifferenceOf(values, 0, blocks);
    if (judged) map->cells[place] = {judged->median_m};
  }
  std::vector<GroundRegion> found;
  for (const std::vector<CellIndex>& cluster : Clusters(differing)) {
    GroundRegion region;
    std::size_t steep = 0;
    for (const CellIndex& place : cluster) {
      map->cells[place].region = static_cast<int>(found.size());
      region.p_chosen = std::min(region.p_chosen, differing[place].p);
      steep += HasWall(cells.at(place)) ? 1 : 0;
    }
    region.p_chosen = std::min(1.0, kWindows * static_cast<double>(cells.size()) * region.p_chosen);
    region.upright = static_cast<double>(steep) > kWallShare * static_cast<double>(cluster.size());
    found.push_back(region);
  }
  return found;
}

}  // namespace

GroundMap CompareGround(const RangeSource& source, const ScanSplit& split,
                        const SensorCalibration& calibration, double scale,
                        const PointFlags& excluded) {
  GroundMap map;
  std::vector<HeightDifference> seen, held_out;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    AddHeightDifferences(source, calibration, scale, s, excluded[s], map.cell_m,
                         split.part[s] == Part::kFinal ? &held_out : &seen);
  }
  Cells cells;
  for (const HeightDifference& s : seen) cells[s.cell][split.block[s.scan]].push_back(s.above_m);
  std::vector<GroundRegion> found = FindRegions(cells, split, &map);
  FillGaps(&map);
  std::vector<int> kept_as(found.size(), -1);
  std::vector<HeightDifference> all = seen;
  all.insert(all.end(), held_out.begin(), held_out.end());
  for (std::size_t r = 0; r < found.size(); ++r) {
    const int index = static_cast<int>(r);
    Measure(map, index, &found[r]);
    found[r].upright = IsObject(found[r]);
    Confirm(held_out, split, map, index, &found[r]);
    found[r].intervals_s = TimesOf(source, split, BlocksOf(all, split, map, index), found[r]);
    const bool holds =
        found[r].p_confirmed <= kConfirmedRegionP / static_cast<double>(found.size());
    if (holds) kept_as[r] = static_cast<int>(map.regions.size());
    (holds ? map.regions : map.unconfirmed).push_back(found[r]);
  }
  for (auto& [place, cell] : map.cells) {
    if (cell.region >= 0) cell.region = kept_as[static_cast<std::size_t>(cell.region)];
  }
  map.explained = NoPoints(source.scans);
  for (const HeightDifference& s : all) {
    if (IsNearRegion(map, s.cell) || IsNearRegion(map, s.simulated)) {
      map.explained[s.scan][s.point] = true;
    }
  }
  return map;
}

}  // namespace tera
