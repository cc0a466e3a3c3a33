#include "diagnose/perception/dust.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "diagnose/perception/ground_map.h"
#include "diagnose/perception/object_edges.h"
#include "diagnose/statistics/robust.h"

namespace tera {
namespace {

constexpr double kBefore_m = 0.5, kOverGround_m = 0.3;
constexpr double kCube_m = 0.5, kStep_m = 0.25;
constexpr int kReach = 2;
constexpr std::size_t kFewestReturns = 40, kFewestBlocks = 3;
constexpr double kThing = 0.6, kThick_m = 0.1, kRare = 0.005, kFloor = 0.001;
constexpr double kChosen = 0.05, kConfirmed = 0.01;
constexpr double kPresent = 0.25;  ///< of a cloud's densest tenth: less is clear air

using Cube = std::array<int, 3>;

Cube CubeAt(const Vec3& p_W_m) {
  const Vec3 at = (p_W_m / kCube_m).array().floor();
  return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
}

struct Stray {
  std::size_t scan, point;
  Vec3 p_W_m;
};

/// Rays that came to a cloud in one block of time.
struct Count {
  double stopped = 0, passed = 0;
  double share() const { return stopped / (stopped + passed); }
};

/// Every measured ray as it was.
struct Path {
  std::size_t scan;
  Vec3 from_W_m, d_W;
  double length_m;
};

void AddScan(const RangeSource& source, const SensorNumbers& numbers, std::size_t scan,
             std::vector<Stray>* strays, std::vector<Path>* paths) {
  const std::vector<RangePoint>& points = source.scans[scan].points;
  const std::vector<SimulatedReturn> hits = source.cast(scan, numbers, BeamsOf(source.scans[scan]));
  std::vector<std::size_t> near;
  std::vector<Vec3> near_W_m;
  const Vec3 p_BT_m = source.X_BS.translation() + numbers.shift_B_m();
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (hits[p].surface == Surface::kUnknown) continue;
    const Vec3 from_W_m = hits[p].X_WB * p_BT_m;
    const Vec3 p_W_m = PointInWorld(source, numbers, points[p], hits[p]);
    const double length_m = (p_W_m - from_W_m).norm();
    paths->push_back({scan, from_W_m, (p_W_m - from_W_m) / length_m, length_m});
    if (hits[p].surface != Surface::kNothing && length_m > hits[p].range_m - kBefore_m) continue;
    const auto ground_m = source.ground_m(scan, p_W_m.head<2>());
    if (!ground_m || p_W_m.z() < *ground_m + kOverGround_m) continue;
    near.push_back(p);
    near_W_m.push_back(p_W_m);
  }
  const std::vector<bool> on_edge = OnEdges(source, numbers, scan, near);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!on_edge[i]) strays->push_back({scan, near[i], near_W_m[i]});
  }
}

/// A number for each cube: its cloud.
std::map<Cube, int> Clouds(const std::vector<Stray>& strays, int* count) {
  std::map<Cube, int> cloud;
  for (const Stray& stray : strays) cloud[CubeAt(stray.p_W_m)] = -1;
  *count = 0;
  for (auto& [start, number] : cloud) {
    if (number >= 0) continue;
    number = *count;
    std::vector<Cube> open = {start};
    while (!open.empty()) {
      const Cube at = open.back();
      open.pop_back();
      for (int a = -kReach; a <= kReach; ++a) {
        for (int b = -kReach; b <= kReach; ++b) {
          for (int c = -kReach; c <= kReach; ++c) {
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

/// Probability of shares so far above the rarest that counts, by chance.
double P(const std::vector<double>& shares) {
  if (shares.size() < kFewestBlocks) return 1;
  const auto n = static_cast<double>(shares.size());
  const double mean = std::accumulate(shares.begin(), shares.end(), 0.0) / n;
  double square = 0;
  for (const double s : shares) square += (s - mean) * (s - mean);
  const double sigma = std::sqrt(square / (n - 1) / n + kFloor * kFloor);
  return boost::math::cdf(
      boost::math::complement(boost::math::students_t(n - 1), (mean - kRare) / sigma));
}

struct Tally {
  std::map<std::size_t, Count> blocks;
  std::vector<const Stray*> strays;
};

/// Counts each ray once a cloud that it went through, unless it ended there.
void CountPassing(const std::vector<Path>& paths, const ScanSplit& split,
                  const std::map<Cube, int>& cloud, std::vector<Tally>* tallies) {
  for (const Path& path : paths) {
    std::vector<int> met;
    for (double r = kStep_m; r < path.length_m - kCube_m; r += kStep_m) {
      const auto at = cloud.find(CubeAt(path.from_W_m + r * path.d_W));
      if (at == cloud.end() || std::find(met.begin(), met.end(), at->second) != met.end()) continue;
      met.push_back(at->second);
    }
    const auto end = cloud.find(CubeAt(path.from_W_m + path.length_m * path.d_W));
    for (const int number : met) {
      if (end != cloud.end() && end->second == number) continue;
      (*tallies)[static_cast<std::size_t>(number)].blocks[split.block[path.scan]].passed += 1;
    }
  }
}

void AddIntervals(const RangeSource& source, const ScanSplit& split, const Tally& tally,
                  DustCloud* cloud) {
  std::vector<double> shares;
  for (const auto& [block, count] : tally.blocks) shares.push_back(count.share());
  const double dense = Quantile(shares, 0.9);
  bool open = false, always = true;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    const auto at = tally.blocks.find(split.block[s]);
    if (at == tally.blocks.end()) continue;
    const bool is_there = at->second.share() > kPresent * dense;
    always = always && is_there;
    const double t_s = ToSeconds(source.scans[s].t_ns - source.start_ns);
    if (is_there && !open) cloud->intervals_s.emplace_back(t_s, t_s);
    if (is_there) cloud->intervals_s.back().second = t_s;
    open = is_there;
  }
  if (always) cloud->intervals_s.clear();
}

/// Median over cubic metres of the least standard deviation of the returns in them.
double ThicknessOf(const std::vector<const Stray*>& strays) {
  constexpr std::size_t kFewest = 6;
  std::map<Cube, std::vector<Vec3>> cubes;
  for (const Stray* stray : strays) cubes[CubeAt(0.5 * stray->p_W_m)].push_back(stray->p_W_m);
  std::vector<double> thickness_m;
  for (const auto& [cube, points] : cubes) {
    if (points.size() < kFewest) continue;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    Mat3 covariance = Mat3::Zero();
    for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance /
                                                     static_cast<double>(points.size() - 1));
    thickness_m.push_back(std::sqrt(std::max(0.0, solver.eigenvalues()[0])));
  }
  return thickness_m.empty() ? 0 : Median(thickness_m);
}

DustCloud CloudOf(const RangeSource& source, const ScanSplit& split, const Tally& tally) {
  DustCloud cloud;
  cloud.returns = tally.strays.size();
  cloud.low_W_m = cloud.high_W_m = tally.strays.front()->p_W_m;
  for (const Stray* stray : tally.strays) {
    cloud.centre_W_m += stray->p_W_m / static_cast<double>(tally.strays.size());
    cloud.low_W_m = cloud.low_W_m.cwiseMin(stray->p_W_m);
    cloud.high_W_m = cloud.high_W_m.cwiseMax(stray->p_W_m);
  }
  cloud.thickness_m = ThicknessOf(tally.strays);
  std::vector<bool> is_final(split.blocks);
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    is_final[split.block[s]] = split.part[s] == Part::kFinal;
  }
  std::vector<double> seen, held_out;
  Count all;
  for (const auto& [block, count] : tally.blocks) {
    (is_final[block] ? held_out : seen).push_back(count.share());
    all.stopped += count.stopped;
    all.passed += count.passed;
  }
  cloud.stopped = all.share();
  cloud.p_chosen = P(seen);
  cloud.p_confirmed = P(held_out);
  AddIntervals(source, split, tally, &cloud);
  return cloud;
}

}  // namespace

Dust FindDust(const RangeSource& source, const ScanSplit& split, const SensorNumbers& numbers) {
  Dust dust{{}, NoPoints(source.scans)};
  std::vector<Stray> strays;
  std::vector<Path> paths;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    AddScan(source, numbers, s, &strays, &paths);
  }
  if (strays.size() < kFewestReturns) return dust;
  int count = 0;
  std::map<Cube, int> cloud = Clouds(strays, &count);
  std::vector<Tally> tallies(static_cast<std::size_t>(count));
  for (const Stray& stray : strays) {
    Tally& tally = tallies[static_cast<std::size_t>(cloud.at(CubeAt(stray.p_W_m)))];
    tally.strays.push_back(&stray);
    tally.blocks[split.block[stray.scan]].stopped += 1;
  }
  std::erase_if(cloud, [&](const auto& cube) {
    return tallies[static_cast<std::size_t>(cube.second)].strays.size() < kFewestReturns;
  });
  if (cloud.empty()) return dust;
  const auto large =
      static_cast<double>(std::count_if(tallies.begin(), tallies.end(), [](const Tally& tally) {
        return tally.strays.size() >= kFewestReturns;
      }));
  CountPassing(paths, split, cloud, &tallies);
  for (const Tally& tally : tallies) {
    if (tally.strays.size() < kFewestReturns) continue;
    const DustCloud one = CloudOf(source, split, tally);
    const bool is_sure = one.p_chosen <= kChosen / large && one.p_confirmed <= kConfirmed / large;
    if (!is_sure || one.stopped > kThing || one.thickness_m < kThick_m) continue;
    for (const Stray* stray : tally.strays) dust.explained[stray->scan][stray->point] = true;
    dust.clouds.push_back(one);
  }
  return dust;
}

}  // namespace tera
