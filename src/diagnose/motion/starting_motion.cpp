#include "diagnose/motion/starting_motion.h"

#include <algorithm>
#include <cmath>

#include "diagnose/motion/link_motion.h"

namespace tera {
namespace {

constexpr double kLeastBaseline_m = 0.2;  ///< shorter baselines between antennas give no heading
constexpr double kLeastPath_m = 2;        ///< shorter paths give no heading
constexpr double kNear_s = 0.3;           ///< largest gap between samples of the other antenna
constexpr double kHalfFootprint_m = 0.6;

struct BaseAt {
  double t_s = 0;
  Vec3 p_m = Vec3::Zero();
  Vec3 rpy_rad = Vec3::Zero();
};

std::vector<BaseAt> ByPoses(const RoughSources& sources) {
  std::vector<BaseAt> base;
  for (std::size_t k = 0; k < sources.poses.size(); ++k) {
    base.push_back({sources.poses_t_s[k], sources.poses[k].translation(),
                    RpyFromRotation(sources.poses[k].linear())});
  }
  return base;
}

/// Heading from the direction between two antennas.
std::vector<BaseAt> ByPair(const RoughSources& sources) {
  std::vector<BaseAt> base;
  const AntennaTrack &a = sources.antennas[0], &b = sources.antennas[1];
  for (std::size_t k = 0; k < a.t_s.size(); ++k) {
    const double t_s = a.t_s[k];
    const auto next = std::lower_bound(b.t_s.begin(), b.t_s.end(), t_s);
    if (next == b.t_s.begin() || next == b.t_s.end() || *next - *(next - 1) > kNear_s) continue;
    const auto n = static_cast<std::size_t>(next - b.t_s.begin());
    const double s = (t_s - b.t_s[n - 1]) / (b.t_s[n] - b.t_s[n - 1]);
    const Vec3 other_m = (1 - s) * b.p_W_m[n - 1] + s * b.p_W_m[n];
    const Vec3 a_B_m = AntennaInBase(a, sources.joints, t_s);
    const Vec3 along_B = AntennaInBase(b, sources.joints, t_s) - a_B_m;
    if (along_B.head<2>().norm() < kLeastBaseline_m) continue;
    const Vec3 along_W = other_m - a.p_W_m[k];
    const double yaw = std::atan2(along_W.y(), along_W.x()) - std::atan2(along_B.y(), along_B.x());
    base.push_back({t_s, a.p_W_m[k] - RotationFromRpy(0, 0, yaw) * a_B_m, {0, 0, yaw}});
  }
  return base;
}

std::vector<BaseAt> ByTravel(const RoughSources& sources) {
  BaseAt at;
  if (sources.start) {
    at.p_m = sources.start->translation();
    at.rpy_rad.z() = RpyFromRotation(sources.start->linear()).z();
  }
  std::vector<BaseAt> base;
  for (const TravelWindow& window : sources.travel) {
    const double length_s = window.to_s - window.from_s;
    const double yaw = at.rpy_rad.z() + 0.5 * window.turning_radps * length_s;
    if (base.empty()) at.t_s = window.from_s, base.push_back(at);
    at.t_s = window.to_s;
    at.p_m += window.forward_mps * length_s * Vec3(std::cos(yaw), std::sin(yaw), 0);
    at.rpy_rad.z() += window.turning_radps * length_s;
    base.push_back(at);
  }
  if (base.empty()) base.push_back(at);
  return base;
}

std::array<TimeSeries, kBaseNumbers> SeriesOf(const std::vector<BaseAt>& base) {
  std::array<TimeSeries, kBaseNumbers> series;
  double yaw = base.front().rpy_rad.z();
  for (const BaseAt& at : base) {
    yaw += std::remainder(at.rpy_rad.z() - yaw, 2 * kPi);
    const std::array<double, kBaseNumbers> values = {at.p_m.x(),     at.p_m.y(),     at.p_m.z(),
                                                     at.rpy_rad.x(), at.rpy_rad.y(), yaw};
    for (std::size_t i = 0; i < values.size(); ++i) {
      series[i].t_s.push_back(at.t_s);
      series[i].value.push_back(values[i]);
    }
  }
  return series;
}

/// Rotates the travelled path to fit the positions of an antenna. Then moves each pose onto the
/// antenna's position.
std::vector<BaseAt> LaidOver(const RoughSources& sources, const std::vector<BaseAt>& travel) {
  const AntennaTrack& antenna = sources.antennas.front();
  const auto series = SeriesOf(travel);
  Vec2 mean_a = Vec2::Zero(), mean_b = Vec2::Zero();
  std::vector<Vec2> a, b;
  for (std::size_t k = 0; k < antenna.t_s.size(); ++k) {
    const double t_s = antenna.t_s[k], yaw = series[kYaw].At(t_s);
    const Vec3 p_m = AntennaInBase(antenna, sources.joints, t_s);
    const Vec3 away = RotationFromRpy(0, 0, yaw) * p_m;
    a.push_back(Vec2(series[0].At(t_s) + away.x(), series[1].At(t_s) + away.y()));
    b.push_back(antenna.p_W_m[k].head<2>());
    mean_a += a.back() / static_cast<double>(antenna.t_s.size());
    mean_b += b.back() / static_cast<double>(antenna.t_s.size());
  }
  double cosine = 0, sine = 0, spread = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec2 u = a[k] - mean_a, v = b[k] - mean_b;
    cosine += u.dot(v);
    sine += u.x() * v.y() - u.y() * v.x();
    spread = std::max(spread, v.norm());
  }
  const double turn = spread > kLeastPath_m ? std::atan2(sine, cosine) : 0;
  std::vector<BaseAt> base;
  for (std::size_t k = 0; k < antenna.t_s.size(); ++k) {
    const double t_s = antenna.t_s[k], yaw = series[kYaw].At(t_s) + turn;
    const Vec3 p_m = AntennaInBase(antenna, sources.joints, t_s);
    base.push_back({t_s, antenna.p_W_m[k] - RotationFromRpy(0, 0, yaw) * p_m, {0, 0, yaw}});
  }
  return base;
}

}  // namespace

double TimeSeries::At(double at_s) const {
  const auto next = std::lower_bound(t_s.begin(), t_s.end(), at_s);
  if (next == t_s.begin()) return value.front();
  if (next == t_s.end()) return value.back();
  const auto n = static_cast<std::size_t>(next - t_s.begin());
  const double s = (at_s - t_s[n - 1]) / (t_s[n] - t_s[n - 1]);
  return (1 - s) * value[n - 1] + s * value[n];
}

Vec3 AntennaInBase(const AntennaTrack& antenna, const std::vector<TimeSeries>& joints, double t_s) {
  std::array<double, kMostJointsOfChain> q{};
  for (std::size_t s = 0; s < antenna.chain.steps.size(); ++s) {
    const auto place = static_cast<std::size_t>(antenna.chain.steps[s].place);
    if (!joints[place].empty()) q[s] = joints[place].At(t_s);
  }
  return PointInBase<double>(antenna.chain, antenna.p_L_m, q.data());
}

Vec3 OnGround(const GroundHeight& ground, double x_m, double y_m, double yaw_rad) {
  const double c = kHalfFootprint_m * std::cos(yaw_rad), s = kHalfFootprint_m * std::sin(yaw_rad);
  const double front = ground(x_m + c, y_m + s), back = ground(x_m - c, y_m - s),
               left = ground(x_m - s, y_m + c), right = ground(x_m + s, y_m - c);
  return {(front + back + left + right) / 4, std::atan2(left - right, 2 * kHalfFootprint_m),
          std::atan2(back - front, 2 * kHalfFootprint_m)};
}

std::array<TimeSeries, kBaseNumbers> RoughBase(const RoughSources& sources) {
  std::vector<BaseAt> base = ByPoses(sources);
  if (base.empty() && sources.antennas.size() >= 2) base = ByPair(sources);
  if (base.empty()) {
    base = ByTravel(sources);
    const bool has_places = !sources.antennas.empty() && !sources.antennas.front().t_s.empty();
    if (has_places) base = LaidOver(sources, base);
  }
  if (sources.ground && sources.poses.empty()) {
    for (BaseAt& at : base) {
      const Vec3 stands = OnGround(sources.ground, at.p_m.x(), at.p_m.y(), at.rpy_rad.z());
      at.p_m.z() = stands.x();
      at.rpy_rad.head<2>() = stands.tail<2>();
    }
  }
  return SeriesOf(base);
}

}  // namespace tera
