#include "dataset/import/clocks/clock_difference.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/quantile.h"
#include "dataset/import/clocks/lag_search.h"

namespace tera {
namespace {

constexpr double kLeastCorrelation = 0.85, kLeastOfStretch = 0.8;
/// Least length of the compared segment, in widths of the correlation peak. In a shorter segment, a
/// peak may be chance.
constexpr double kFewestEvents = 20;
constexpr std::size_t kFewestStretches = 5;
constexpr double kSegment_s = 600, kMostLag_s = 60;
constexpr double kShortestStretch_s = 8, kLongestStretch_s = 60, kStretches = 12;
constexpr double kLeastAverage_s = 0.1;

/// 97.5 % quantile of Student's t distribution. Source: Student 1908; tables of the distribution.
double Student(std::size_t freedom) {
  constexpr std::array<double, 11> kTable = {12.71, 12.71, 4.30, 3.18, 2.78, 2.57,
                                             2.45,  2.36,  2.31, 2.26, 2.23};
  if (freedom < kTable.size()) return kTable[freedom];
  return 1.96 + 2.5 / static_cast<double>(freedom);  // error below 0.02
}

struct Line {
  double at_origin = 0, slope = 0;
  double origin_bound = 0, slope_bound = 0;
};

/// Weighted straight line through the lags, over the channel's stamps since `origin_s`.
Line Fitted(const std::vector<Stretch>& stretches, double origin_s) {
  const auto n = static_cast<Eigen::Index>(stretches.size());
  Eigen::MatrixX2d X(n, 2);
  Eigen::VectorXd y(n), w(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Stretch& s = stretches[static_cast<std::size_t>(i)];
    X.row(i) << 1, s.middle_s + s.lag_s - origin_s;
    y[i] = s.lag_s;
    w[i] = s.weight;
  }
  w /= w.mean();
  const Eigen::Matrix2d normal = X.transpose() * w.asDiagonal() * X;
  const Eigen::Matrix2d inverse = normal.inverse();
  const Eigen::Vector2d line = inverse * (X.transpose() * w.asDiagonal() * y);
  const Eigen::VectorXd left = y - X * line;
  const std::size_t freedom = stretches.size() - 2;
  const double variance = left.dot(w.asDiagonal() * left) / static_cast<double>(freedom);
  const double t = Student(freedom);
  return {line[0], line[1], t * std::sqrt(variance * inverse(0, 0)),
          t * std::sqrt(variance * inverse(1, 1))};
}

/// Stretches close to the line through the majority.
std::vector<Stretch> WithoutOutliers(const std::vector<Stretch>& stretches, const Line& line,
                                     double origin_s) {
  constexpr double kSigmas = 4, kSigmaOfMedian = 1.4826, kLeast_s = 1e-3;
  const auto off_s = [&](const Stretch& s) {
    return std::abs(s.lag_s - line.at_origin - line.slope * (s.middle_s + s.lag_s - origin_s));
  };
  std::vector<double> all;
  for (const Stretch& s : stretches) all.push_back(off_s(s));
  const double most_s = std::max(kLeast_s, kSigmas * kSigmaOfMedian * Median(std::move(all)));
  std::vector<Stretch> kept;
  std::copy_if(stretches.begin(), stretches.end(), std::back_inserter(kept),
               [&](const Stretch& s) { return off_s(s) <= most_s; });
  return kept;
}

/// The two series with the highest correlation, and their lag.
struct BestPair {
  const MotionSeries* reference = nullptr;
  const MotionSeries* channel = nullptr;
  CoarseLag lag;
};

std::optional<BestPair> BestPairOf(const ChannelMotion& reference, const ChannelMotion& channel) {
  std::optional<BestPair> best;
  for (const MotionSeries& a : reference.series) {
    for (const MotionSeries& b : channel.series) {
      if (a.kind != b.kind) continue;
      const auto lag = FindCoarseLag(a, b, kSegment_s, kMostLag_s);
      if (!lag || (best && lag->correlation <= best->lag.correlation)) continue;
      best = BestPair{&a, &b, *lag};
    }
  }
  return best;
}

double AverageOf_s(const BestPair& pair) {
  return std::max({kLeastAverage_s, pair.reference->averaged_s, pair.channel->averaged_s,
                   2 * ToSeconds(pair.reference->step_ns), 2 * ToSeconds(pair.channel->step_ns)});
}

}  // namespace

bool ClockDifference::IsCertain() const {
  constexpr double kBounds = 2;  // widens the bounds, because many pairs of channels are compared
  return std::abs(ahead_s) > kBounds * ahead_bound_s || std::abs(drift) > kBounds * drift_bound;
}

std::optional<ClockDifference> CompareClocks(const ChannelMotion& reference,
                                             const ChannelMotion& channel) {
  const auto pair = BestPairOf(reference, channel);
  if (!pair || pair->lag.correlation < kLeastCorrelation || !pair->lag.is_alone ||
      pair->lag.length_s < kFewestEvents * pair->lag.width_s) {
    return std::nullopt;
  }
  const StretchedLags lags(*pair->reference, *pair->channel, AverageOf_s(*pair));
  const double length_s = std::clamp(lags.overlap_s(pair->lag.lag_s) / kStretches,
                                     kShortestStretch_s, kLongestStretch_s);
  std::vector<Stretch> stretches = lags.All(pair->lag, length_s, kLeastOfStretch);
  if (stretches.size() < kFewestStretches) return std::nullopt;
  const double origin_s = stretches.front().middle_s + stretches.front().lag_s;
  stretches = WithoutOutliers(stretches, Fitted(stretches, origin_s), origin_s);
  if (stretches.size() < kFewestStretches) return std::nullopt;
  const Line line = Fitted(stretches, origin_s);
  const double half_interval_s = 0.5 * std::max(reference.interval_s, channel.interval_s);
  return ClockDifference{.channel = channel.path,
                         .reference = reference.path,
                         .what = pair->channel->what,
                         .reference_what = pair->reference->what,
                         .from_ns = FromSeconds(origin_s),
                         .ahead_s = line.at_origin,
                         .ahead_bound_s = line.origin_bound + half_interval_s,
                         .drift = line.slope,
                         .drift_bound = line.slope_bound,
                         .correlation = pair->lag.correlation,
                         .stretches = static_cast<int>(stretches.size())};
}

std::vector<ClockDifference> ClockDifferences(const std::vector<ChannelMotion>& channels) {
  std::vector<ClockDifference> differences;
  std::vector<std::string> before;  // earlier clocks
  for (const ChannelMotion& first : channels) {
    const auto is_before = [&](const std::string& clock) {
      return std::find(before.begin(), before.end(), clock) != before.end();
    };
    if (is_before(first.clock)) continue;
    std::optional<ClockDifference> best;
    for (const ChannelMotion& channel : channels) {
      if (channel.clock != first.clock) continue;
      for (const ChannelMotion& reference : channels) {
        if (!is_before(reference.clock)) continue;
        const auto difference = CompareClocks(reference, channel);
        if (difference && (!best || difference->correlation > best->correlation)) {
          best = difference;
        }
      }
    }
    before.push_back(first.clock);
    if (best && best->IsCertain()) differences.push_back(*best);
  }
  return differences;
}

}  // namespace tera
