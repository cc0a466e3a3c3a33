#include "diagnose/motion/reduce_samples.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

constexpr double kLargestStep = 1.5;  ///< largest step between consecutive rows, in usual periods
constexpr double kBlowShare = 0.25;   ///< factor on a second difference (WindowsOf)
/// Second differences within this many robust deviations count as noise.
constexpr double kUsualSecond = 3;
constexpr double kTravelWindow_s = 0.1, kStillMargin_s = 0.3;
constexpr double kLeastMove_rad = 0.004, kNoiseShare = 6;
/// In resolutions: one step to either side, plus rounding.
constexpr double kResolutionShare = 1.5;

/// The largest apparent movement of an angle at rest, to either side.
double RestingMove_rad(const GearTrack& gear) {
  std::vector<double> second;
  for (std::size_t k = 2; k < gear.angle_rad.value.size(); ++k) {
    const auto& angle = gear.angle_rad.value;
    second.push_back(angle[k] - 2 * angle[k - 1] + angle[k - 2]);
  }
  if (second.empty()) return kLeastMove_rad;
  return std::max({kLeastMove_rad, kResolutionShare * gear.resolution_rad,
                   kNoiseShare * RobustScale(second) / std::sqrt(6.0)});
}

bool IsStill(const std::vector<GearTrack>& gears, const std::vector<double>& resting_rad,
             double from_s, double to_s) {
  for (std::size_t g = 0; g < gears.size(); ++g) {
    const auto& t_s = gears[g].angle_rad.t_s;
    const auto first = std::lower_bound(t_s.begin(), t_s.end(), from_s - kStillMargin_s);
    const auto end = std::upper_bound(first, t_s.end(), to_s + kStillMargin_s);
    if (first == end) return false;
    const auto angle = gears[g].angle_rad.value.begin();
    const auto [low, high] =
        std::minmax_element(angle + (first - t_s.begin()), angle + (end - t_s.begin()));
    if (*high - *low > 2 * resting_rad[g]) return false;
  }
  return true;
}

/// True where no rows are lost between two windows.
bool Follows(const ImuWindow& one, const ImuWindow& next) {
  return next.from_ns - one.to_ns < (next.to_ns - next.from_ns) / 2;
}

void SetModelError(std::vector<ImuWindow>* windows) {
  const std::size_t count = windows->size();
  if (count < 3) return;
  std::vector<double> value(count), second(count, 0);
  for (int i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      const ImuWindow& window = (*windows)[k];
      value[k] = i < 3 ? window.w_S_radps[i] : window.f_S_mps2[i - 3];
    }
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const bool follow =
          Follows((*windows)[k - 1], (*windows)[k]) && Follows((*windows)[k], (*windows)[k + 1]);
      second[k] = follow ? value[k - 1] - 2 * value[k] + value[k + 1] : 0;
    }
    const double usual = kUsualSecond * RobustScale(second);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t a = k == 0 ? 0 : k - 1, b = std::min(k + 1, count - 1);
      const double most = LargestMagnitude(std::span(second).subspan(a, b - a + 1));
      (*windows)[k].model_error[i] = kBlowShare * std::max(0.0, most - usual);
    }
  }
}

}  // namespace

TimeNs UsualPeriod_ns(const std::vector<TimeNs>& t_ns) {
  std::vector<double> steps_s;
  for (std::size_t k = 1; k < t_ns.size(); ++k) steps_s.push_back(ToSeconds(t_ns[k] - t_ns[k - 1]));
  return steps_s.empty() ? 0 : FromSeconds(Median(steps_s));
}

std::vector<ImuWindow> WindowsOf(const std::vector<ImuSample>& samples, double longest_s,
                                 const std::function<int(TimeNs)>& segment_of) {
  std::vector<TimeNs> t_ns;
  for (const ImuSample& sample : samples) t_ns.push_back(sample.t_ns);
  const TimeNs period_ns = UsualPeriod_ns(t_ns);
  const auto most =
      static_cast<int>(std::max(1.0, std::round(longest_s / std::max(1e-9, ToSeconds(period_ns)))));
  std::vector<ImuWindow> windows;
  int count = 0;
  const auto close = [&] {
    if (count == 0) return;
    windows.back().w_S_radps /= count;
    windows.back().f_S_mps2 /= count;
    windows.back().share = static_cast<double>(count) / most;
    count = 0;
  };
  for (const ImuSample& sample : samples) {
    const bool follows = count > 0 && count < most &&
                         static_cast<double>(sample.t_ns - windows.back().to_ns) <
                             kLargestStep * static_cast<double>(period_ns) &&
                         segment_of(sample.t_ns) == segment_of(windows.back().to_ns);
    if (!follows) {
      close();
      windows.push_back({sample.t_ns - period_ns, sample.t_ns});
    }
    windows.back().to_ns = sample.t_ns;
    windows.back().w_S_radps += sample.w_WS_S_radps;
    windows.back().f_S_mps2 += sample.f_S_mps2;
    ++count;
  }
  close();
  SetModelError(&windows);
  return windows;
}

Eigen::Matrix<double, 6, 1> WhiteNoiseOf(const std::vector<ImuSample>& samples, double over_s) {
  std::array<std::vector<double>, 6> values;
  std::vector<TimeNs> t_ns;
  for (const ImuSample& sample : samples) {
    t_ns.push_back(sample.t_ns);
    for (int i = 0; i < 6; ++i) {
      values[static_cast<std::size_t>(i)].push_back(i < 3 ? sample.w_WS_S_radps[i]
                                                          : sample.f_S_mps2[i - 3]);
    }
  }
  const double of_mean = std::sqrt(std::min(1.0, ToSeconds(UsualPeriod_ns(t_ns)) / over_s));
  Eigen::Matrix<double, 6, 1> noise;
  for (std::size_t i = 0; i < 6; ++i) {
    noise[static_cast<Eigen::Index>(i)] = of_mean * WhiteNoise({values[i]});
  }
  return noise;
}

void SetMotionOfUnits(MotionProblem* problem) {
  using Row = Eigen::Array<double, 6, 1>;
  struct Sums {
    double count = 0;
    Row value = Row::Zero(), square = Row::Zero();
  };
  std::vector<Sums> sums(problem->imus.size());
  for (const MotionSegment& segment : problem->segments) {
    for (const Observation& one : segment.observations) {
      if (one.kind != ObservationKind::kImu) continue;
      Sums& sum = sums[static_cast<std::size_t>(one.channel)];
      ++sum.count;
      sum.value += one.value.array();
      sum.square += one.value.array().square();
    }
  }
  for (std::size_t u = 0; u < sums.size(); ++u) {
    if (sums[u].count == 0) continue;
    const Row mean = sums[u].value / sums[u].count;
    const Row variance = sums[u].square / sums[u].count - mean.square();
    for (int i = 0; i < 6; ++i) {
      problem->noise[static_cast<std::size_t>(problem->imus[u].noise + i)].motion =
          std::sqrt(std::max(0.0, variance[i]));
    }
  }
}

std::vector<TravelWindow> TravelOf(const std::vector<GearTrack>& gears) {
  std::vector<TravelWindow> windows;
  const auto is_unread = [](const GearTrack& gear) { return gear.angle_rad.empty(); };
  if (gears.empty() || std::any_of(gears.begin(), gears.end(), is_unread)) return windows;
  std::vector<double> resting_rad;
  Eigen::MatrixXd design(static_cast<Eigen::Index>(gears.size()), 2);
  bool can_turn = false;
  for (std::size_t g = 0; g < gears.size(); ++g) {
    resting_rad.push_back(RestingMove_rad(gears[g]));
    design.row(static_cast<Eigen::Index>(g)) << 1, -gears[g].left_m;
    can_turn = can_turn || std::abs(gears[g].left_m - gears.front().left_m) > 0.1;
  }
  const Eigen::MatrixXd solve =
      can_turn ? Eigen::MatrixXd(design.completeOrthogonalDecomposition().pseudoInverse())
               : Eigen::MatrixXd::Zero(2, design.rows());
  const auto& t_s = gears.front().angle_rad.t_s;
  std::size_t begin = 0;
  for (std::size_t k = 1; k < t_s.size(); ++k) {
    if (t_s[k] - t_s[begin] < kTravelWindow_s - 1e-3) continue;
    Eigen::VectorXd speed(design.rows());
    for (std::size_t g = 0; g < gears.size(); ++g) {
      const TimeSeries& angle = gears[g].angle_rad;
      speed[static_cast<Eigen::Index>(g)] =
          gears[g].radius_m * (angle.At(t_s[k]) - angle.At(t_s[begin])) / (t_s[k] - t_s[begin]);
    }
    TravelWindow window{t_s[begin], t_s[k]};
    window.is_still = IsStill(gears, resting_rad, t_s[begin], t_s[k]);
    if (!window.is_still) {
      const Eigen::VectorXd twist = solve * speed;
      window.forward_mps = can_turn ? twist[0] : speed.mean();
      window.turning_radps = twist[1];
    }
    windows.push_back(window);
    begin = k;
  }
  return windows;
}

}  // namespace tera
