#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/units.h"
#include "diagnose/perception/scans/range_source.h"
#include "diagnose/perception/true_sensor.h"

/// A site with a tilted plane and a box in closed form, and a lidar that turns above it.

namespace tera::testing {

/// Ground z = x gx + y gy, with excavation or fill, and a box at an oblique angle.
struct AnalyticScene {
  Vec2 slope = {0.05, -0.03};
  /// Height of the ground over the plane, level where it is not 0.
  std::function<double(const Vec2& xy_m)> relief;
  /// A ball of dust that stops a ray after four metres on average.
  bool has_dust = false;
  Vec3 dust_W_m = {3.5, -1.5, 1.6};
  double dust_radius_m = 1.2;
  double dust_from_s = 0, dust_to_s = 1e9;
  bool has_box = true;
  Pose X_WX = MakePose({6, 3, 0.5}, 0.1, -0.05, 0.7);
  Vec3 half_m = {1.0, 1.5, 1.2};

  double Ground_m(const Vec2& xy_m) const { return slope.dot(xy_m) + (relief ? relief(xy_m) : 0); }
};

struct AnalyticHit {
  Surface surface = Surface::kNothing;
  double range_m = std::numeric_limits<double>::infinity();
  Vec3 normal_W = Vec3::Zero();
};

inline constexpr double kMarch_m = 0.06;

/// The ground by marching and bisection, the box by its slabs.
inline AnalyticHit CastInto(const AnalyticScene& scene, const Vec3& p_W_m, const Vec3& d_W,
                            double reach_m) {
  AnalyticHit hit;
  const Vec3 n(-scene.slope.x(), -scene.slope.y(), 1);
  const double plane_m = -n.dot(p_W_m) / n.dot(d_W);
  if (n.dot(d_W) < 0 && plane_m < reach_m) {
    hit = {Surface::kGround, plane_m, n.normalized()};
  }
  const auto over_m = [&](double r) {
    const Vec3 p = p_W_m + r * d_W;
    return p.z() - scene.Ground_m(p.head<2>());
  };
  // Relief within 1.5 m of the plane changes the ray's impact.
  const double fall = -n.dot(d_W);
  if (scene.relief && fall > 0) {
    const double from_m = std::max(0.0, plane_m - 1.5 / fall), to_m = plane_m + 1.5 / fall;
    for (double r = from_m; r < std::min(to_m, reach_m); r += kMarch_m) {
      if (over_m(r) > 0) continue;
      double a = r - kMarch_m, b = r;
      for (int k = 0; k < 30; ++k) (over_m(0.5 * (a + b)) > 0 ? a : b) = 0.5 * (a + b);
      hit = {Surface::kGround, b, n.normalized()};
      break;
    }
  }
  if (!scene.has_box) return hit;
  const Vec3 p_X = scene.X_WX.inverse() * p_W_m, d_X = scene.X_WX.linear().transpose() * d_W;
  double enter = 0, leave = reach_m;
  int face = -1;
  for (int a = 0; a < 3; ++a) {
    const double t1 = (-scene.half_m[a] - p_X[a]) / d_X[a];
    const double t2 = (scene.half_m[a] - p_X[a]) / d_X[a];
    if (std::min(t1, t2) > enter) face = a;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  if (face >= 0 && enter < leave && enter < hit.range_m) {
    Vec3 n_X = Vec3::Zero();
    n_X[face] = d_X[face] > 0 ? -1 : 1;
    hit = {Surface::kObstacle, enter, scene.X_WX.linear() * n_X};
  }
  return hit;
}

/// Turns back and forth by 0.6 rad over 6 s, rocks a little, and creeps forward.
inline Pose LinkAt(double t_s) {
  return MakePose({0.05 * t_s, -0.02 * t_s, 1.6}, 0.01 * std::sin(0.9 * t_s), -0.02,
                  0.3 + 0.6 * std::sin(t_s));
}

/// Range at which dust ends a ray, for a draw in (0, 1); infinite if the ray passes.
inline double DustStop_m(const AnalyticScene& scene, const Vec3& p_W_m, const Vec3& d_W,
                         double draw) {
  const double along_m = d_W.dot(scene.dust_W_m - p_W_m);
  const double aside_m = (p_W_m + along_m * d_W - scene.dust_W_m).norm();
  if (aside_m > scene.dust_radius_m) return std::numeric_limits<double>::infinity();
  const double half_m = std::sqrt(scene.dust_radius_m * scene.dust_radius_m - aside_m * aside_m);
  const double depth_m = -4 * std::log(draw);
  return depth_m < 2 * half_m ? along_m - half_m + depth_m
                              : std::numeric_limits<double>::infinity();
}

struct LidarOfTest {
  TrueSensor is;
  double noise_m = 0.01;
  double duration_s = 40, period_s = 0.5;
  bool moves = true;
  std::uint64_t seed = 5;
};

/// Scans of `real` by a lidar on the link, to be compared with `simulated`.
inline RangeSource RecordedBy(const LidarOfTest& lidar, const AnalyticScene& real,
                              const AnalyticScene& simulated) {
  RangeSource source;
  source.channel = "excavator1/lidar";
  source.target = "lidar";
  source.X_BS = MakePose({0.3, 0.2, 0.7}, 0.02, 0.2, -0.4);
  const auto link_at = [moves = lidar.moves](double t_s) { return LinkAt(moves ? t_s : 1.0); };
  const Stream noise(lidar.seed, "test/range"), dust(lidar.seed, "test/dust");
  const double turn_s = 0.1, reach_m = 25;
  std::uint64_t draw = 0;
  const Pose X_BT = lidar.is.Calibration(source.X_BS).X_BT;
  for (double t_s = 0; t_s < lidar.duration_s; t_s += lidar.period_s) {
    RangeScan scan;
    scan.t_ns = FromSeconds(t_s + lidar.is.clock_offset_s);
    for (int column = 0; column < 120; ++column) {
      for (int ring = 0; ring < 12; ++ring) {
        const double azimuth_rad = 2 * kPi * column / 120, rise_rad = (-32 + 3 * ring) * kDeg;
        const Vec3 d_T(std::cos(rise_rad) * std::cos(azimuth_rad),
                       std::cos(rise_rad) * std::sin(azimuth_rad), std::sin(rise_rad));
        const double since_s = turn_s * column / 120;
        const Pose X_WB = link_at(t_s + since_s);
        const Vec3 p_W_m = X_WB * Vec3(X_BT.translation());
        const Vec3 d_W = X_WB.linear() * (X_BT.linear() * d_T);
        AnalyticHit hit = CastInto(real, p_W_m, d_W, reach_m);
        if (real.has_dust && t_s >= real.dust_from_s && t_s <= real.dust_to_s) {
          const double stop_m = DustStop_m(real, p_W_m, d_W, dust.Uniform(draw));
          if (stop_m > 0 && stop_m < hit.range_m) hit = {Surface::kObstacle, stop_m, -d_W};
        }
        if (hit.surface == Surface::kNothing) continue;
        const double r_m = lidar.is.range_factor * hit.range_m + lidar.is.range_bias_m +
                           lidar.noise_m * noise.Gaussian(draw++);
        scan.points.push_back({r_m * d_T, FromSeconds(since_s), lidar.noise_m});
      }
    }
    source.scans.push_back(std::move(scan));
  }
  source.start_ns = source.scans.front().t_ns;
  const std::vector<RangeScan>& scans = source.scans;
  std::vector<TimeNs> times;
  for (const RangeScan& scan : scans) times.push_back(scan.t_ns);
  source.cast = [=](std::size_t scan, const SensorCalibration& calibration,
                    const std::vector<Beam>& beams) {
    std::vector<SimulatedReturn> returns;
    for (const Beam& beam : beams) {
      const double t_s = ToSeconds(times[scan] + beam.since_ns) - calibration.clock_offset_s;
      SimulatedReturn one;
      one.X_WB = link_at(t_s);
      const double dt_s = 1e-4;
      const Pose before = link_at(t_s - dt_s), after = link_at(t_s + dt_s);
      one.v_WB_mps = (after.translation() - before.translation()) / (2 * dt_s);
      const Eigen::AngleAxisd turn(after.linear() * before.linear().transpose());
      one.w_WB_radps = turn.axis() * turn.angle() / (2 * dt_s);
      const Vec3 p_W_m = one.X_WB * Vec3(calibration.X_BT.translation());
      const Vec3 d_W = one.X_WB.linear() * (calibration.X_BT.linear() * beam.d_S);
      const AnalyticHit hit = CastInto(simulated, p_W_m, d_W, 1.5 * reach_m);
      one.surface = hit.surface;
      one.range_m = hit.range_m;
      one.normal_W = hit.normal_W;
      one.object = hit.surface == Surface::kObstacle ? 1 : 0;
      returns.push_back(one);
    }
    return returns;
  };
  source.ground_m = [simulated](std::size_t, const Vec2& xy_m) -> std::optional<double> {
    if (xy_m.cwiseAbs().maxCoeff() > 20) return std::nullopt;
    return simulated.Ground_m(xy_m);
  };
  source.name_of = [](int) { return std::string("box1"); };
  return source;
}

}  // namespace tera::testing
