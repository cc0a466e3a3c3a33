#include "dataset/import/clocks/lag_search.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr float kNoMean = std::numeric_limits<float>::quiet_NaN();
constexpr double kCoarseStep_s = 0.1, kCoarseAverage_s = 0.2;
constexpr double kShortestSegment_s = 20;
/// Least fraction of present values in a usable segment.
constexpr double kLeastFilled = 0.7;
/// Factor by which the highest correlation peak must exceed the second.
constexpr double kExcels = 7.0 / 6;

/// Moving mean over an odd number of values. Missing values are ignored if most are present.
std::vector<float> Averaged(const std::vector<float>& values, std::size_t half) {
  if (half == 0) return values;
  std::vector<double> sums(values.size() + 1, 0);
  std::vector<std::size_t> counts(values.size() + 1, 0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool is_there = !std::isnan(values[k]);
    sums[k + 1] = sums[k] + (is_there ? values[k] : 0.0);
    counts[k + 1] = counts[k] + (is_there ? 1 : 0);
  }
  std::vector<float> means(values.size(), kNoMean);
  for (std::size_t k = half; k + half < values.size(); ++k) {
    const std::size_t count = counts[k + half + 1] - counts[k - half];
    if (2 * count > 2 * half + 1) {
      means[k] =
          static_cast<float>((sums[k + half + 1] - sums[k - half]) / static_cast<double>(count));
    }
  }
  return means;
}

/// Equally spaced values of a series minus their mean. Missing values are 0.
struct Samples {
  std::vector<float> values;
  std::size_t filled = 0;
};
Samples Centred(const SmoothSeries& series, double from_s, double step_s, std::size_t count) {
  Samples samples;
  samples.values.resize(count);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    samples.values[k] = series.At(from_s + step_s * static_cast<double>(k));
    if (std::isnan(samples.values[k])) continue;
    sum += samples.values[k];
    ++samples.filled;
  }
  const auto mean =
      static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, samples.filled)));
  for (float& v : samples.values) v = std::isnan(v) ? 0 : v - mean;
  return samples;
}

double Energy(const float* from, std::size_t count) {
  double energy = 0;
  for (std::size_t k = 0; k < count; ++k) energy += from[k] * from[k];
  return energy;
}

using Vector = Eigen::Map<const Eigen::VectorXf>;

/// Correlation at each lag from -most to most.
std::vector<double> Correlations(const std::vector<float>& a, const std::vector<float>& b) {
  const double energy_a = Energy(a.data(), a.size());
  const double most_b = Energy(b.data(), b.size());
  const auto size = static_cast<Eigen::Index>(a.size());
  std::vector<double> all;
  double energy_b = Energy(b.data(), a.size());
  for (std::size_t lag = 0; lag + a.size() <= b.size(); ++lag) {
    const float sum = Vector(a.data(), size).dot(Vector(b.data() + lag, size));
    // A segment of the second series with little motion is ignored, even if it correlates well.
    const bool tells = energy_a > 0 && energy_b > 0.1 * most_b * static_cast<double>(a.size()) /
                                                      static_cast<double>(b.size());
    all.push_back(tells ? sum / std::sqrt(energy_a * energy_b) : 0);
    if (lag + a.size() < b.size()) {
      energy_b += b[lag + a.size()] * b[lag + a.size()] - b[lag] * b[lag];
    }
  }
  return all;
}

/// Distance from the peak to half of its height, on the wider side.
std::size_t HalfWidth(const std::vector<double>& heights, std::size_t peak) {
  std::size_t below = 1, above = 1;
  while (below <= peak && heights[peak - below] > 0.5 * heights[peak]) ++below;
  while (peak + above < heights.size() && heights[peak + above] > 0.5 * heights[peak]) ++above;
  return std::max(below, above);
}

/// Start of the segment of the first series that has the most motion.
double LiveliestFrom(const SmoothSeries& series, double length_s, double step_s) {
  const auto count = static_cast<std::size_t>((series.last_s() - series.first_s()) / step_s) + 1;
  const Samples all = Centred(series, series.first_s(), step_s, count);
  const auto length = std::min(count, static_cast<std::size_t>(length_s / step_s));
  double energy = Energy(all.values.data(), length), most = energy;
  std::size_t best = 0;
  for (std::size_t from = 1; from + length <= count; ++from) {
    const double in = all.values[from + length - 1], out = all.values[from - 1];
    energy += in * in - out * out;
    if (energy > most) {
      most = energy;
      best = from;
    }
  }
  return series.first_s() + step_s * static_cast<double>(best);
}

}  // namespace

SmoothSeries::SmoothSeries(const MotionSeries& series, double averaged_s)
    : first_s_(ToSeconds(series.first_ns)), step_s_(ToSeconds(series.step_ns)) {
  const double rest_s = averaged_s > series.averaged_s ? averaged_s : 0;
  values_ = Averaged(series.values, static_cast<std::size_t>(0.5 * rest_s / step_s_));
}

double SmoothSeries::last_s() const {
  return first_s_ + step_s_ * static_cast<double>(values_.size() - 1);
}

float SmoothSeries::At(double t_s) const {
  const double place = (t_s - first_s_) / step_s_;
  if (!(place >= 0) || place > static_cast<double>(values_.size() - 1)) return kNoMean;
  const auto before = std::min(static_cast<std::size_t>(place), values_.size() - 2);
  const auto share = static_cast<float>(place - static_cast<double>(before));
  return values_[before] + share * (values_[before + 1] - values_[before]);
}

std::optional<CoarseLag> FindCoarseLag(const MotionSeries& first, const MotionSeries& second,
                                       double longest_segment_s, double most_lag_s) {
  const double step_s =
      std::max({kCoarseStep_s, ToSeconds(first.step_ns), ToSeconds(second.step_ns)});
  const double averaged_s =
      std::max({kCoarseAverage_s, first.averaged_s, second.averaged_s, step_s});
  const SmoothSeries a(first, averaged_s), b(second, averaged_s);
  CoarseLag coarse;
  coarse.length_s = std::min(longest_segment_s, a.last_s() - a.first_s());
  if (coarse.length_s < kShortestSegment_s) return std::nullopt;
  coarse.from_s = LiveliestFrom(a, coarse.length_s, step_s);
  const auto count = static_cast<std::size_t>(coarse.length_s / step_s);
  const auto lags = static_cast<std::size_t>(most_lag_s / step_s);
  const Samples of_a = Centred(a, coarse.from_s, step_s, count);
  const Samples of_b =
      Centred(b, coarse.from_s - step_s * static_cast<double>(lags), step_s, count + 2 * lags);
  const double needed = kLeastFilled * static_cast<double>(count);
  if (static_cast<double>(of_a.filled) < needed || static_cast<double>(of_b.filled) < needed) {
    return std::nullopt;
  }
  std::vector<double> heights = Correlations(of_a.values, of_b.values);
  const auto size = [&](double h) { return first.kind == MotionKind::kTurn ? std::abs(h) : h; };
  const auto lower = [&](double x, double y) { return size(x) < size(y); };
  const auto peak = static_cast<std::size_t>(
      std::max_element(heights.begin(), heights.end(), lower) - heights.begin());
  coarse.opposite = heights[peak] < 0;
  for (double& h : heights) h = size(h);
  const std::size_t width = HalfWidth(heights, peak);
  double next = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const std::size_t away = k > peak ? k - peak : peak - k;
    if (away > 2 * width) next = std::max(next, heights[k]);
  }
  coarse.correlation = heights[peak];
  coarse.is_alone = heights[peak] >= kExcels * next;
  coarse.width_s = step_s * static_cast<double>(2 * width);
  coarse.lag_s = step_s * (static_cast<double>(peak) - static_cast<double>(lags));
  return coarse;
}

StretchedLags::StretchedLags(const MotionSeries& first, const MotionSeries& second,
                             double averaged_s)
    : first_(first, averaged_s),
      second_(second, averaged_s),
      step_s_(std::max({0.01, ToSeconds(first.step_ns), ToSeconds(second.step_ns)})) {}

double StretchedLags::overlap_s(double lag_s) const {
  return std::min(first_.last_s(), second_.last_s() - lag_s) -
         std::max(first_.first_s(), second_.first_s() - lag_s);
}

StretchedLags::Match StretchedLags::At(double from_s, double length_s, double lag_s) const {
  const auto count = static_cast<std::size_t>(length_s / step_s_);
  double n = 0, a_sum = 0, b_sum = 0, aa = 0, bb = 0, ab = 0, steps = 0;
  double before = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < count; ++k) {
    const double t_s = from_s + step_s_ * static_cast<double>(k);
    const double a = first_.At(t_s), b = second_.At(t_s + lag_s);
    if (std::isnan(a) || std::isnan(b)) continue;
    n += 1;
    a_sum += a;
    b_sum += b;
    aa += a * a;
    bb += b * b;
    ab += a * b;
    if (!std::isnan(before)) steps += (a - before) * (a - before);
    before = a;
  }
  if (n < kLeastFilled * static_cast<double>(count) || n < 2) return {};
  const double var_a = aa / n - (a_sum / n) * (a_sum / n);
  const double var_b = bb / n - (b_sum / n) * (b_sum / n);
  if (!(var_a > 0) || !(var_b > 0)) return {};
  const double cov = ab / n - (a_sum / n) * (b_sum / n);
  return {cov / std::sqrt(var_a * var_b), std::sqrt(var_a), steps / (step_s_ * step_s_) / var_a};
}

std::optional<Stretch> StretchedLags::Near(double from_s, double length_s, double lag_s,
                                           double sign, double least_correlation,
                                           double least_motion) const {
  constexpr double kReach_s = 0.5;
  const int reach = std::max(3, static_cast<int>(kReach_s / step_s_));
  std::vector<Match> matches;
  for (int k = -reach; k <= reach; ++k) {
    matches.push_back(At(from_s, length_s, lag_s + step_s_ * k));
  }
  const auto best = std::max_element(
      matches.begin(), matches.end(),
      [&](const auto& x, const auto& y) { return sign * x.correlation < sign * y.correlation; });
  const auto at = best - matches.begin();
  const double r = sign * best->correlation;
  if (at == 0 || at == 2 * reach || r < least_correlation || best->motion < least_motion) {
    return std::nullopt;
  }
  // Vertex of the parabola through the three highest values.
  const double below = sign * (best - 1)->correlation, above = sign * (best + 1)->correlation;
  const double bend = below - 2 * r + above;
  if (!(bend < 0)) return std::nullopt;
  const double top = 0.5 * (below - above) / bend;
  constexpr double kLeastNoise = 1e-6;
  return Stretch{from_s + 0.5 * length_s, lag_s + step_s_ * (static_cast<double>(at - reach) + top),
                 best->sharpness * r * r / (1 - r * r + kLeastNoise)};
}

std::vector<Stretch> StretchedLags::All(const CoarseLag& coarse, double length_s,
                                        double least_correlation) const {
  constexpr double kLeastMotion = 0.25;  // relative to the segment with the most motion
  const double sign = coarse.opposite ? -1 : 1;
  const double least_motion =
      kLeastMotion * At(coarse.from_s, coarse.length_s, coarse.lag_s).motion;
  const double first_s = std::max(first_.first_s(), second_.first_s() - coarse.lag_s);
  const double last_s = std::min(first_.last_s(), second_.last_s() - coarse.lag_s);
  std::vector<Stretch> found;
  const auto walk = [&](double from_s, double step_s) {
    double lag_s = coarse.lag_s;
    for (; from_s >= first_s && from_s + length_s <= last_s; from_s += step_s) {
      const auto stretch = Near(from_s, length_s, lag_s, sign, least_correlation, least_motion);
      if (!stretch) continue;
      lag_s = stretch->lag_s;
      found.push_back(*stretch);
    }
  };
  const double middle_s = std::clamp(coarse.from_s + 0.5 * coarse.length_s, first_s, last_s);
  walk(middle_s, length_s);
  walk(middle_s - length_s, -length_s);
  std::sort(found.begin(), found.end(),
            [](const Stretch& x, const Stretch& y) { return x.middle_s < y.middle_s; });
  return found;
}

}  // namespace tera
