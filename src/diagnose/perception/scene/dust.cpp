#include "diagnose/perception/scene/dust.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "diagnose/perception/scene/ground_map.h"
#include "diagnose/perception/scene/height_differences.h"
#include "diagnose/perception/scene/moderated_t_test.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

/// Least distances of an air return from the simulated surface and from the ground.
constexpr double kLeastBeforeSurface_m = 0.5, kLeastOverGround_m = 0.3;
constexpr double kVoxel_m = 0.5;
constexpr double kStep_m = 0.5 * kVoxel_m;      ///< step along a ray through voxels
constexpr int kCloudReach = 2;                  ///< distance in voxels at which voxels are linked
constexpr std::size_t kFewestReturns = 40;      ///< minimum per cloud
constexpr std::size_t kFewestOfCubicMetre = 6;  ///< needed to compute a scatter
constexpr std::size_t kMostParts = 8;           ///< largest number of parts of a recording
constexpr double kMostStopped = 0.6;  ///< share of rays: a cloud that stops more is a solid object
constexpr double kLeastThickness_m = 0.1;  ///< thinner is a surface
/// Tests if more than one ray in 200 ends in a cloud. The prior is eight blocks that agree within a
/// tenth.
constexpr ModeratedTTest kMoreThanRare{.limit = 0.005, .prior_blocks = 8, .prior_scatter = 0.1};
constexpr double kChosenP = 0.05, kConfirmedCloudP = 0.01;  ///< levels over all clouds
/// A block shows clear air if its share of stopped rays, over the 0.9 quantile of all blocks, is
/// smaller.
constexpr double kLeastPresent = 0.25;

using Voxel = std::array<int, 3>;

Voxel VoxelAt(const Vec3& p_W_m) {
  const Vec3 at = (p_W_m / kVoxel_m).array().floor();
  return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
}

struct AirReturn {
  std::size_t scan, point;
  Vec3 p_W_m;
};

/// Rays that reach a cloud in one block of time.
struct CloudRays {
  double stopped = 0, passed = 0;
  double share() const { return stopped / (stopped + passed); }
};

struct MeasuredRay {
  std::size_t scan;
  Vec3 from_W_m, d_W;
  double length_m;
};

void AddScan(const RangeSource& source, const SensorCalibration& calibration, std::size_t scan,
             std::vector<AirReturn>* air_returns, std::vector<MeasuredRay>* rays) {
  const std::vector<RangePoint>& points = source.scans[scan].points;
  const std::vector<SimulatedReturn> hits =
      source.cast(scan, calibration, BeamsOf(source.scans[scan]));
  std::vector<std::size_t> near;
  std::vector<Vec3> near_W_m;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (hits[p].surface == Surface::kUnknown) continue;
    const Vec3 from_W_m = hits[p].X_WB * Vec3(calibration.X_BT.translation());
    const Vec3 p_W_m = PointInWorld(source, calibration, points[p], hits[p]);
    const double length_m = (p_W_m - from_W_m).norm();
    rays->push_back({scan, from_W_m, (p_W_m - from_W_m) / length_m, length_m});
    if (hits[p].surface != Surface::kNothing && length_m > hits[p].range_m - kLeastBeforeSurface_m)
      continue;
    const auto ground_m = source.ground_m(scan, p_W_m.head<2>());
    if (!ground_m || p_W_m.z() < *ground_m + kLeastOverGround_m) continue;
    near.push_back(p);
    near_W_m.push_back(p_W_m);
  }
  const std::vector<bool> on_edge = OnOcclusionEdges(source, calibration, scan, near);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!on_edge[i]) air_returns->push_back({scan, near[i], near_W_m[i]});
  }
}

/// Links voxels with returns into clouds. Returns the cloud index of each voxel.
std::map<Voxel, int> Clouds(const std::vector<AirReturn>& air_returns, int* count) {
  std::map<Voxel, int> cloud;
  for (const AirReturn& air_return : air_returns) cloud[VoxelAt(air_return.p_W_m)] = -1;
  *count = 0;
  for (auto& [start, number] : cloud) {
    if (number >= 0) continue;
    number = *count;
    std::vector<Voxel> open = {start};
    while (!open.empty()) {
      const Voxel at = open.back();
      open.pop_back();
      for (int a = -kCloudReach; a <= kCloudReach; ++a) {
        for (int b = -kCloudReach; b <= kCloudReach; ++b) {
          for (int c = -kCloudReach; c <= kCloudReach; ++c) {
            const auto next = cloud.find({at[0] + a, at[1] + b, at[2] + c});
            if (next == cloud.end() || next->second >= 0) continue;
            next->second = *count;
            open.push_back(next->first);
          }
        }
      }
    }
    ++*count;
  }
  return cloud;
}

struct CloudTally {
  std::map<std::size_t, CloudRays> blocks;
  std::vector<const AirReturn*> air_returns;
};

/// Counts the rays that pass through a cloud without ending in it, at most once per cloud.
void CountPassingRays(const std::vector<MeasuredRay>& rays, const ScanSplit& split,
                      const std::map<Voxel, int>& cloud, std::vector<CloudTally>* tallies) {
  for (const MeasuredRay& ray : rays) {
    std::vector<int> met;
    for (double r = kStep_m; r < ray.length_m - kVoxel_m; r += kStep_m) {
      const auto at = cloud.find(VoxelAt(ray.from_W_m + r * ray.d_W));
      if (at == cloud.end() || std::find(met.begin(), met.end(), at->second) != met.end()) continue;
      met.push_back(at->second);
    }
    const auto end = cloud.find(VoxelAt(ray.from_W_m + ray.length_m * ray.d_W));
    for (const int number : met) {
      if (end != cloud.end() && end->second == number) continue;
      (*tallies)[static_cast<std::size_t>(number)].blocks[split.block[ray.scan]].passed += 1;
    }
  }
}

/// Blocks from `first` to `end`, without `end`.
struct Window {
  std::size_t first = 0, end = 0;
  double p = 1;
  bool Has(std::size_t block) const { return block >= first && block < end; }
};

using Shares = std::map<std::size_t, double>;

std::vector<double> SharesIn(const Shares& shares, const Window& window) {
  std::vector<double> within;
  for (const auto& [block, share] : shares) {
    if (window.Has(block)) within.push_back(share);
  }
  return within;
}

/// The window with the smallest p among the whole recording, its halves, quarters and eighths. The
/// returned p is corrected for this choice (Bonferroni).
Window ShownBestIn(const Shares& seen, std::size_t blocks) {
  Window best{0, blocks, 1};
  double windows = 0;
  for (std::size_t parts = 1; parts <= kMostParts; parts *= 2) {
    for (std::size_t k = 0; k < parts; ++k) {
      Window window{k * blocks / parts, (k + 1) * blocks / parts, 1};
      window.p = kMoreThanRare.P(SharesIn(seen, window));
      if (window.p < best.p) best = window;
      windows += 1;
    }
  }
  best.p = std::min(1.0, windows * best.p);
  return best;
}

/// Window from the first to the last block in which more than `least` of the rays end in the cloud.
Window PresentIn(const Shares& seen, double least) {
  Window present;
  for (const auto& [block, share] : seen) {
    if (share <= least) continue;
    if (present.end == 0) present.first = block;
    present.end = block + 1;
  }
  return present;
}

/// Median over returns of the least standard deviation of those in their cubic metre.
double ThicknessOf(const std::vector<const AirReturn*>& air_returns) {
  std::map<Voxel, std::vector<Vec3>> voxels;
  for (const AirReturn* air_return : air_returns)
    voxels[VoxelAt(0.5 * air_return->p_W_m)].push_back(air_return->p_W_m);
  std::vector<double> thickness_m;
  for (const auto& [voxel, points] : voxels) {
    if (points.size() < kFewestOfCubicMetre) continue;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    Mat3 covariance = Mat3::Zero();
    for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance /
                                                     static_cast<double>(points.size() - 1));
    thickness_m.insert(thickness_m.end(), points.size(),
                       std::sqrt(std::max(0.0, solver.eigenvalues()[0])));
  }
  return thickness_m.empty() ? 0 : Median(thickness_m);
}

DustCloud CloudOf(const RangeSource& source, const ScanSplit& split, const CloudTally& tally) {
  DustCloud cloud;
  cloud.returns = tally.air_returns.size();
  const Vec3& first_W_m = tally.air_returns.front()->p_W_m;
  cloud.low_W_m = cloud.high_W_m = first_W_m.head<2>();
  cloud.top_m = first_W_m.z();
  for (const AirReturn* air_return : tally.air_returns) {
    const Vec2 xy_W_m = air_return->p_W_m.head<2>();
    cloud.centre_W_m += xy_W_m / static_cast<double>(tally.air_returns.size());
    cloud.low_W_m = cloud.low_W_m.cwiseMin(xy_W_m);
    cloud.high_W_m = cloud.high_W_m.cwiseMax(xy_W_m);
    cloud.top_m = std::max(cloud.top_m, air_return->p_W_m.z());
  }
  cloud.thickness_m = ThicknessOf(tally.air_returns);
  std::vector<bool> is_final(split.blocks);
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    is_final[split.block[s]] = split.part[s] == Part::kFinal;
  }
  Shares seen, held_out;
  for (const auto& [block, count] : tally.blocks) {
    (is_final[block] ? held_out : seen)[block] = count.share();
  }
  const Window best = ShownBestIn(seen, split.blocks);
  cloud.p_chosen = best.p;
  if (best.p >= 1) return cloud;
  const double least = kLeastPresent * Quantile(SharesIn(seen, best), 0.9);
  const Window present = PresentIn(seen, least);
  cloud.p_confirmed = kMoreThanRare.P(SharesIn(held_out, present));
  CloudRays while_there;
  for (const auto& [block, count] : tally.blocks) {
    if (!present.Has(block)) continue;
    while_there.stopped += count.stopped;
    while_there.passed += count.passed;
  }
  cloud.stopped = while_there.share();
  std::map<std::size_t, bool> is_there;
  for (const auto& [block, count] : tally.blocks) is_there[block] = count.share() > least;
  cloud.intervals_s = IntervalsOf(source, split, is_there);
  return cloud;
}

}  // namespace

Dust FindDust(const RangeSource& source, const ScanSplit& split,
              const SensorCalibration& calibration) {
  Dust dust{{}, {}, NoPoints(source.scans)};
  std::vector<AirReturn> air_returns;
  std::vector<MeasuredRay> rays;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    AddScan(source, calibration, s, &air_returns, &rays);
  }
  if (air_returns.size() < kFewestReturns) return dust;
  int count = 0;
  std::map<Voxel, int> cloud = Clouds(air_returns, &count);
  std::vector<CloudTally> tallies(static_cast<std::size_t>(count));
  for (const AirReturn& air_return : air_returns) {
    CloudTally& tally = tallies[static_cast<std::size_t>(cloud.at(VoxelAt(air_return.p_W_m)))];
    tally.air_returns.push_back(&air_return);
    tally.blocks[split.block[air_return.scan]].stopped += 1;
  }
  std::erase_if(cloud, [&](const auto& voxel) {
    return tallies[static_cast<std::size_t>(voxel.second)].air_returns.size() < kFewestReturns;
  });
  if (cloud.empty()) return dust;
  const auto large = static_cast<double>(std::count_if(
      tallies.begin(), tallies.end(),
      [](const CloudTally& tally) { return tally.air_returns.size() >= kFewestReturns; }));
  CountPassingRays(rays, split, cloud, &tallies);
  for (const CloudTally& tally : tallies) {
    if (tally.air_returns.size() < kFewestReturns) continue;
    const DustCloud one = CloudOf(source, split, tally);
    const bool is_chosen = one.p_chosen <= kChosenP / large;
    if (!is_chosen || one.stopped > kMostStopped || one.thickness_m < kLeastThickness_m) continue;
    const bool is_confirmed = one.p_confirmed <= kConfirmedCloudP / large;
    (is_confirmed ? dust.clouds : dust.unconfirmed).push_back(one);
    for (const AirReturn* air_return : tally.air_returns)
      dust.explained[air_return->scan][air_return->point] = true;
  }
  return dust;
}

}  // namespace tera
