#include "diagnose/perception/scans/ground_map.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/units.h"
#include "diagnose/perception/scans/object_edges.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

using Place = std::pair<int, int>;

constexpr double kOnObject_m = 0.15, kOnObjectSigmas = 6;
constexpr double kSuspicious_m = 0.04;
constexpr double kCliff_m = 0.08;  ///< heights so near may be meant
constexpr double kDeepest_m = 10;
constexpr double kFloor_m = 0.01, kLeast_m = 0.05;
constexpr double kPriorDof = 8, kPriorScatter_m = 0.02;
constexpr double kFalseShare = 0.01, kConfirmed = 0.01, kHalf = 0.5;
constexpr std::size_t kFewestBlocksOfCell = 3, kFewestPoints = 6, kFewestCells = 4;
constexpr int kReach = 2;             ///< cells between members of a region
constexpr double kSteep_m = 0.3;      ///< of heights within one cell
constexpr double kSteepShare = 0.35;  ///< of a region's cells
constexpr double kSteepest = 1.7;     ///< of soil: 60 deg
constexpr double kWindows = 3;        ///< the recording and its two halves

/// Height over the simulated ground of one point.
struct Sounding {
  std::size_t scan, point, block;
  Place cell;
  double above_m;
  Place simulated;  ///< cell of what the ray meets in the simulation
};

bool LiesOnObject(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
                  const SimulatedReturn& hit, double scale) {
  if (hit.surface != Surface::kObstacle && hit.surface != Surface::kMachine) return false;
  const double near_m = std::max(kOnObject_m, kOnObjectSigmas * scale * point.sigma_m);
  return std::abs(BeyondSurface_m(source, numbers, point, hit)) < near_m;
}

/// Whether the height is one that the simulated ground has within a few centimetres.
bool IsOnCliff(const RangeSource& source, std::size_t scan, const Vec3& p_W_m) {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const auto h = source.ground_m(scan, p_W_m.head<2>() + kCliff_m * Vec2(a, b));
      if (!h) continue;
      low_m = std::min(low_m, *h);
      high_m = std::max(high_m, *h);
    }
  }
  return p_W_m.z() > low_m - kFloor_m && p_W_m.z() < high_m + kFloor_m && high_m - low_m > kLeast_m;
}

/// Soundings of one scan.
void Sound(const RangeSource& source, const ScanSplit& split, const SensorNumbers& numbers,
           double scale, std::size_t scan, const std::vector<bool>& left_out, const GroundMap& map,
           std::vector<Sounding>* soundings) {
  const std::vector<RangePoint>& points = source.scans[scan].points;
  const std::vector<SimulatedReturn> hits = source.cast(scan, numbers, BeamsOf(source.scans[scan]));
  std::vector<Sounding> suspicious;
  std::vector<std::size_t> suspects;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (left_out[p] || hits[p].surface == Surface::kUnknown) continue;
    if (LiesOnObject(source, numbers, points[p], hits[p], scale)) continue;
    const Vec3 p_W_m = PointInWorld(source, numbers, points[p], hits[p]);
    const auto ground_m = source.ground_m(scan, p_W_m.head<2>());
    if (!ground_m || std::abs(p_W_m.z() - *ground_m) > kDeepest_m) continue;
    Sounding sounding{
        scan, p, split.block[scan], map.CellAt(p_W_m.head<2>()), p_W_m.z() - *ground_m, {}};
    sounding.simulated = sounding.cell;
    if (hits[p].surface != Surface::kNothing) {
      const Vec3 d_W = hits[p].X_WB.linear() *
                       (source.X_BS.linear() * (numbers.R_ST() * points[p].p_S_m.normalized()));
      const double short_m = TruePoint(source, numbers, points[p].p_S_m).norm() - hits[p].range_m;
      sounding.simulated = map.CellAt((p_W_m - short_m * d_W).head<2>());
    }
    if (std::abs(sounding.above_m) < kSuspicious_m) {
      soundings->push_back(sounding);
    } else if (!IsOnCliff(source, scan, p_W_m)) {
      suspicious.push_back(sounding);
      suspects.push_back(p);
    }
  }
  const std::vector<bool> on_edge = OnEdges(source, numbers, scan, suspects);
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    if (!on_edge[i]) soundings->push_back(suspicious[i]);
  }
}

/// Values of one cell, a list a block.
using CellBlocks = std::map<std::size_t, std::vector<double>>;
using Cells = std::map<Place, CellBlocks>;

struct MeanOfBlocks {
  double mean_m, sigma_m;
  double p;  ///< of a mean so far on one side by chance
};

/// Student's t, the variance shrunk to that of blocks which agree within 2 cm, as if there were
/// eight more of these: where few blocks see a place, their own scatter says little.
MeanOfBlocks MeanOf(const std::vector<double>& medians) {
  const auto n = static_cast<double>(medians.size());
  const double mean_m = std::accumulate(medians.begin(), medians.end(), 0.0) / n;
  double square = kPriorDof * kPriorScatter_m * kPriorScatter_m;
  for (const double m : medians) square += (m - mean_m) * (m - mean_m);
  const double dof = kPriorDof + n - 1;
  const double sigma_m = std::sqrt(square / dof / n + kFloor_m * kFloor_m);
  const double p = boost::math::cdf(
      boost::math::complement(boost::math::students_t(dof), std::abs(mean_m) / sigma_m));
  return {mean_m, sigma_m, p};
}

struct Judged {
  double middle_m, sigma_m, p;
  std::size_t blocks;
};

/// Student's t of medians of blocks.
std::optional<Judged> Judge(const CellBlocks& blocks, double first, double last) {
  std::vector<double> medians;
  std::size_t points = 0;
  for (const auto& [block, values] : blocks) {
    if (static_cast<double>(block) < first || static_cast<double>(block) >= last) continue;
    medians.push_back(Median(values));
    points += values.size();
  }
  if (medians.size() < kFewestBlocksOfCell || points < kFewestPoints) return std::nullopt;
  const MeanOfBlocks of = MeanOf(medians);
  return Judged{Median(medians), of.sigma_m, 2 * of.p, medians.size()};
}

/// Whether there are walls in a cell.
bool IsSteep(const CellBlocks& blocks) {
  std::size_t steep = 0, known = 0;
  for (const auto& [block, values] : blocks) {
    if (values.size() < 2) continue;
    ++known;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    steep += *high - *low > kSteep_m ? 1 : 0;
  }
  return known > 0 && 2 * steep >= known;
}

/// Cells that differ in a window of blocks, with how sure that is.
std::map<Place, Judged> Differing(const Cells& cells, double first, double last) {
  std::vector<std::pair<double, Place>> by_p;
  std::map<Place, Judged> judged;
  for (const auto& [place, blocks] : cells) {
    const auto one = Judge(blocks, first, last);
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
  std::map<Place, Judged> differing;
  for (std::size_t k = 0; k < kept; ++k) {
    const Judged& one = judged[by_p[k].second];
    if (std::abs(one.middle_m) >= kLeast_m) differing[by_p[k].second] = one;
  }
  return differing;
}

/// Connected cells of one sign.
std::vector<std::vector<Place>> Clusters(const std::map<Place, Judged>& cells) {
  std::vector<std::vector<Place>> clusters;
  std::set<Place> taken;
  for (const auto& [start, first] : cells) {
    if (taken.contains(start)) continue;
    std::vector<Place> cluster = {start};
    taken.insert(start);
    for (std::size_t next = 0; next < cluster.size(); ++next) {
      for (int a = -kReach; a <= kReach; ++a) {
        for (int b = -kReach; b <= kReach; ++b) {
          const Place near = {cluster[next].first + a, cluster[next].second + b};
          const auto at = cells.find(near);
          if (at == cells.end() || taken.contains(near)) continue;
          if ((at->second.middle_m > 0) != (first.middle_m > 0)) continue;
          taken.insert(near);
          cluster.push_back(near);
        }
      }
    }
    if (cluster.size() >= kFewestCells) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

/// Unseen cells take over what the nearest one within reach shows.
void FillGaps(GroundMap* map) {
  std::map<Place, GroundCell> filled;
  for (const auto& [place, cell] : map->cells) {
    if (cell.region < 0) continue;
    for (int a = -kReach; a <= kReach; ++a) {
      for (int b = -kReach; b <= kReach; ++b) {
        const Place near = {place.first + a, place.second + b};
        if (map->cells.contains(near) || filled.contains(near)) continue;
        const GroundCell* nearest = nullptr;
        int distance = std::numeric_limits<int>::max();
        for (int c = -kReach; c <= kReach; ++c) {
          for (int d = -kReach; d <= kReach; ++d) {
            const auto at = map->cells.find({near.first + c, near.second + d});
            if (at == map->cells.end() || c * c + d * d >= distance) continue;
            distance = c * c + d * d;
            nearest = &at->second;
          }
        }
        if (nearest == nullptr || nearest->region < 0) continue;
        filled[near] = *nearest;
        filled[near].seen = false;
      }
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

/// Whether soil cannot stand so: what is higher than simulated has walls, or is higher than a cone
/// of kSteepest on its area.
bool IsThing(const GroundRegion& region) {
  if (region.mean_m < 0) return false;
  return region.upright || region.highest_m > kSteepest * std::sqrt(region.area_m2 / kPi);
}

bool IsNearRegion(const GroundMap& map, const Place& place) {
  for (int a = -1; a <= 1; ++a) {
    for (int b = -1; b <= 1; ++b) {
      const auto at = map.cells.find({place.first + a, place.second + b});
      if (at != map.cells.end() && at->second.region >= 0) return true;
    }
  }
  return false;
}

/// Mean difference of a region's soundings, a number a block.
std::map<std::size_t, std::vector<double>> BlocksOf(const std::vector<Sounding>& soundings,
                                                    const GroundMap& map, int index) {
  std::map<std::size_t, std::vector<double>> blocks;
  for (const Sounding& s : soundings) {
    const auto at = map.cells.find(s.cell);
    if (at != map.cells.end() && at->second.region == index) blocks[s.block].push_back(s.above_m);
  }
  return blocks;
}

/// When the region differs, where that is not all the time.
void AddIntervals(const RangeSource& source, const ScanSplit& split,
                  const std::map<std::size_t, std::vector<double>>& blocks, GroundRegion* region) {
  std::vector<double> means;
  for (const auto& [block, values] : blocks) means.push_back(Median(values));
  const double full_m = region->mean_m > 0 ? Quantile(means, 0.9) : Quantile(means, 0.1);
  std::map<std::size_t, std::pair<TimeNs, TimeNs>> times;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    auto& time =
        times.try_emplace(split.block[s], source.scans[s].t_ns, source.scans[s].t_ns).first->second;
    time.second = source.scans[s].t_ns;
  }
  bool open = false, always = true;
  for (const auto& [block, values] : blocks) {
    const bool differs = Median(values) / full_m > kHalf;
    always = always && differs;
    const double from_s = ToSeconds(times[block].first - source.start_ns);
    const double to_s = ToSeconds(times[block].second - source.start_ns);
    if (differs && !open) region->intervals_s.emplace_back(from_s, to_s);
    if (differs) region->intervals_s.back().second = to_s;
    open = differs;
  }
  if (always) region->intervals_s.clear();
}

void Confirm(const std::vector<Sounding>& final_soundings, const GroundMap& map, int index,
             GroundRegion* region) {
  std::vector<double> medians;
  double before = 0, after = 0, count = 0;
  for (const auto& [block, values] : BlocksOf(final_soundings, map, index)) {
    medians.push_back(Median(values));
  }
  for (const Sounding& s : final_soundings) {
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
  const MeanOfBlocks of = MeanOf(medians);
  if (of.mean_m / region->mean_m < kHalf) return;
  region->p_confirmed = of.p;
}

/// Clusters of cells that differ in the whole recording or in one half of it, and the cells of the
/// map. Of the regions only how sure they are, and whether they have walls.
std::vector<GroundRegion> FindRegions(const Cells& cells, const ScanSplit& split, GroundMap* map) {
  const auto blocks = static_cast<double>(split.blocks);
  std::map<Place, Judged> differing = Differing(cells, 0, blocks);
  for (const auto& part : {Differing(cells, 0, blocks / 2), Differing(cells, blocks / 2, blocks)}) {
    differing.insert(part.begin(), part.end());
  }
  for (const auto& [place, values] : cells) {
    const auto own = differing.find(place);
    const auto judged =
        own != differing.end() ? std::optional(own->second) : Judge(values, 0, blocks);
    if (judged) map->cells[place] = {judged->middle_m, judged->sigma_m, judged->blocks, -1, true};
  }
  std::vector<GroundRegion> found;
  for (const std::vector<Place>& cluster : Clusters(differing)) {
    GroundRegion region;
    std::size_t steep = 0;
    for (const Place& place : cluster) {
      map->cells[place].region = static_cast<int>(found.size());
      region.p_chosen = std::min(region.p_chosen, differing[place].p);
      steep += IsSteep(cells.at(place)) ? 1 : 0;
    }
    region.p_chosen = std::min(1.0, kWindows * static_cast<double>(cells.size()) * region.p_chosen);
    region.upright = static_cast<double>(steep) > kSteepShare * static_cast<double>(cluster.size());
    found.push_back(region);
  }
  return found;
}

}  // namespace

std::pair<int, int> GroundMap::CellAt(const Vec2& xy_W_m) const {
  return {static_cast<int>(std::floor(xy_W_m.x() / cell_m)),
          static_cast<int>(std::floor(xy_W_m.y() / cell_m))};
}

std::vector<std::vector<bool>> NoPoints(const std::vector<RangeScan>& scans) {
  std::vector<std::vector<bool>> none;
  for (const RangeScan& scan : scans) none.emplace_back(scan.points.size());
  return none;
}

GroundMap CompareGround(const RangeSource& source, const ScanSplit& split,
                        const SensorNumbers& numbers, double scale,
                        const std::vector<std::vector<bool>>& left_out) {
  GroundMap map;
  std::vector<Sounding> seen, held_out;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    Sound(source, split, numbers, scale, s, left_out[s], map,
          split.part[s] == Part::kFinal ? &held_out : &seen);
  }
  Cells cells;
  for (const Sounding& s : seen) cells[s.cell][s.block].push_back(s.above_m);
  std::vector<GroundRegion> found = FindRegions(cells, split, &map);
  FillGaps(&map);
  std::vector<int> kept_as(found.size(), -1);
  std::vector<Sounding> all = seen;
  all.insert(all.end(), held_out.begin(), held_out.end());
  for (std::size_t r = 0; r < found.size(); ++r) {
    const int index = static_cast<int>(r);
    Measure(map, index, &found[r]);
    found[r].upright = IsThing(found[r]);
    Confirm(held_out, map, index, &found[r]);
    AddIntervals(source, split, BlocksOf(all, map, index), &found[r]);
    const bool holds = found[r].p_confirmed <= kConfirmed / static_cast<double>(found.size());
    if (holds) kept_as[r] = static_cast<int>(map.regions.size());
    (holds ? map.regions : map.unconfirmed).push_back(found[r]);
  }
  for (auto& [place, cell] : map.cells) {
    if (cell.region >= 0) cell.region = kept_as[static_cast<std::size_t>(cell.region)];
  }
  map.explained = NoPoints(source.scans);
  for (const Sounding& s : all) {
    if (IsNearRegion(map, s.cell) || IsNearRegion(map, s.simulated)) {
      map.explained[s.scan][s.point] = true;
    }
  }
  return map;
}

}  // namespace tera
