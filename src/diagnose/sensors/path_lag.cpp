#include "diagnose/sensors/path_lag.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

using Complex = std::complex<double>;

constexpr double kFurthestLag_s = 60, kLag_s = 0.1;
constexpr double kApart_s = 1;    ///< distance from the found lag at which a lag counts as another
constexpr double kMean_s = 1;     ///< time over which fixes are averaged
constexpr double kPeriods = 2;    ///< fixes averaged at low rates
constexpr int kStepsOfBlock = 5;  ///< steps in a block with one turn
constexpr std::size_t kMostPathParts = 24;  ///< independent parts of a recording
/// The same distance in standard deviations; the larger one holds.
constexpr double kApartSigmas = 4;
constexpr std::size_t kFewestSteps = 10;
/// Largest power of the first difference of white noise, over its variance.
constexpr double kLoudest = 2;
constexpr double kLeastNoise_m = 1e-3;  ///< smallest noise of a step, by rounding of fixes

/// Steps between means over consecutive seconds.
struct Steps {
  std::vector<Complex> moved_m;
  std::vector<char> is_known;
};

/// Fit of the path's steps to the steps of the fixes.
struct Fit {
  double share = 0, power_m2 = 0;
  std::vector<Complex> turn;
  std::vector<double> left_m2;  ///< residual sum of squares, by block
  std::vector<std::size_t> steps;

  double Left_m2() const {
    double sum = 0;
    for (const double left : left_m2) sum += left;
    return sum;
  }
  double Degrees() const {
    double degrees = -1;
    for (const std::size_t n : steps) degrees += n > 0 ? 2.0 * static_cast<double>(n) - 1 : 0;
    return std::max(1.0, degrees);
  }
};

class Comparison {
 public:
  Comparison(const PlanarPath& path, const std::vector<PlanarFix>& fixes)
      : path_(path), fixes_(fixes) {
    const double length_s = fixes.back().t_s - fixes.front().t_s;
    const double period_s = length_s / static_cast<double>(fixes.size() - 1);
    mean_s_ = std::max(kMean_s, kPeriods * period_s);
    measured_ = StepsOf([&](const PlanarFix& fix, Complex* at_m) {
      *at_m = fix.at_m;
      return true;
    });
    blocks_ = measured_.moved_m.size() / kStepsOfBlock + 1;
  }

  Steps PathWith(double lag_s) const {
    return StepsOf([&](const PlanarFix& fix, Complex* at_m) {
      if (!path_.Covers(fix.t_s - lag_s)) return false;
      *at_m = path_.At(fix.t_s - lag_s);
      return true;
    });
  }
  std::size_t CountOf(const Steps& steps) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < size(); ++k) count += IsThere(steps, k);
    return count;
  }
  std::size_t size() const { return measured_.moved_m.size(); }
  bool IsThere(const Steps& steps, std::size_t k) const {
    return measured_.is_known[k] && steps.is_known[k];
  }
  /// Fits the path's steps to the fixes on the masked seconds. Unknown steps of the path count as
  /// 0.
  Fit FitOf(const Steps& steps, const std::vector<char>& mask) const;
  std::vector<char> MaskOf(const Steps& a, const Steps& b) const {
    std::vector<char> mask(size());
    for (std::size_t k = 0; k < size(); ++k) mask[k] = IsThere(a, k) && IsThere(b, k);
    return mask;
  }
  const std::vector<char>& all() const { return measured_.is_known; }
  std::vector<ManoeuvreGain> GainsOf(const Steps& better, const Steps& other,
                                     const std::vector<char>& mask, double noise_m2) const;

 private:
  template <typename Place>
  Steps StepsOf(const Place& place) const;

  const PlanarPath& path_;
  const std::vector<PlanarFix>& fixes_;
  double mean_s_ = kMean_s;
  Steps measured_;
  std::size_t blocks_ = 0;
};

/// Means of `place` over the fixes of each second. A second is unknown where `place` fails for one
/// of its fixes.
template <typename Place>
Steps Comparison::StepsOf(const Place& place) const {
  const double start_s = fixes_.front().t_s;
  const auto second_of = [&](const PlanarFix& fix) {
    return static_cast<std::size_t>((fix.t_s - start_s) / mean_s_);
  };
  std::vector<Complex> mean_m(second_of(fixes_.back()) + 1);
  std::vector<char> is_known(mean_m.size(), 0);
  for (std::size_t k = 0; k < fixes_.size();) {
    const std::size_t second = second_of(fixes_[k]);
    double count = 0;
    bool are_all = true;
    for (; k < fixes_.size() && second_of(fixes_[k]) == second; ++k, ++count) {
      Complex at_m;
      are_all = are_all && place(fixes_[k], &at_m);
      mean_m[second] += at_m;
    }
    mean_m[second] /= count;
    is_known[second] = are_all;
  }
  Steps steps;
  for (std::size_t k = 1; k < mean_m.size(); ++k) {
    const bool are_known = is_known[k - 1] && is_known[k];
    steps.is_known.push_back(are_known);
    steps.moved_m.push_back(are_known ? mean_m[k] - mean_m[k - 1] : Complex());
  }
  return steps;
}

Fit Comparison::FitOf(const Steps& steps, const std::vector<char>& mask) const {
  Fit fit;
  fit.turn.assign(blocks_, 0);
  fit.left_m2.assign(blocks_, 0);
  fit.steps.assign(blocks_, 0);
  std::vector<double> power_m2(blocks_, 0);
  double common_m2 = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (!mask[k]) continue;
    const std::size_t b = k / kStepsOfBlock;
    fit.turn[b] += std::conj(steps.moved_m[k]) * measured_.moved_m[k];
    fit.left_m2[b] += std::norm(measured_.moved_m[k]);
    power_m2[b] += std::norm(steps.moved_m[k]);
    ++fit.steps[b];
  }
  for (std::size_t b = 0; b < blocks_; ++b) {
    common_m2 += std::abs(fit.turn[b]);
    fit.power_m2 += power_m2[b];
  }
  fit.share = fit.power_m2 > 0 ? common_m2 / fit.power_m2 : 0;
  for (std::size_t b = 0; b < blocks_; ++b) {
    const double common = std::abs(fit.turn[b]);
    fit.left_m2[b] += fit.share * (fit.share * power_m2[b] - 2 * common);
    fit.left_m2[b] = std::max(0.0, fit.left_m2[b]);
    if (common > 0) fit.turn[b] /= common;
  }
  return fit;
}

std::vector<ManoeuvreGain> Comparison::GainsOf(const Steps& better, const Steps& other,
                                               const std::vector<char>& mask,
                                               double noise_m2) const {
  const Fit a = FitOf(better, mask), b = FitOf(other, mask);
  std::vector<ManoeuvreGain> gains(blocks_);
  for (std::size_t k = 0; k < size(); ++k) {
    if (!mask[k]) continue;
    const std::size_t block = k / kStepsOfBlock;
    gains[block].possible += std::norm(a.share * a.turn[block] * better.moved_m[k] -
                                       b.share * b.turn[block] * other.moved_m[k]);
  }
  for (std::size_t block = 0; block < blocks_; ++block) {
    if (a.steps[block] == 0) continue;
    const double degrees = 2.0 * static_cast<double>(a.steps[block]) - 1;
    const double here_m2 = std::min(a.left_m2[block], b.left_m2[block]) / degrees;
    const double twice_m2 = 2 * std::max(noise_m2, kLoudest * here_m2);
    gains[block].gain = (b.left_m2[block] - a.left_m2[block]) / twice_m2;
    gains[block].possible /= twice_m2;
  }
  std::vector<ManoeuvreGain> parts(std::min(kMostPathParts, blocks_));
  for (std::size_t block = 0; block < blocks_; ++block) {
    ManoeuvreGain& part = parts[block * parts.size() / blocks_];
    part.gain += gains[block].gain;
    part.possible += gains[block].possible;
  }
  return parts;
}

std::vector<double> Lags() {
  std::vector<double> lags_s;
  const int most = static_cast<int>(std::lround(kFurthestLag_s / kLag_s));
  for (int k = -most; k <= most; ++k) lags_s.push_back(k * kLag_s);
  return lags_s;
}

/// Moves the lag to the vertex of a parabola through the sums of squares of neighbouring lags. Also
/// sets its standard deviation.
void Refine(const Comparison& comparison, PathLag* found) {
  const Steps early = comparison.PathWith(found->lag_s - kLag_s),
              here = comparison.PathWith(found->lag_s),
              late = comparison.PathWith(found->lag_s + kLag_s);
  std::vector<char> mask = comparison.MaskOf(early, late);
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = mask[k] && here.is_known[k];
  const Fit before = comparison.FitOf(early, mask), at = comparison.FitOf(here, mask),
            after = comparison.FitOf(late, mask);
  const double curvature =
      (before.Left_m2() - 2 * at.Left_m2() + after.Left_m2()) / kLag_s / kLag_s;
  if (curvature <= 0) {
    found->sigma_s = std::numeric_limits<double>::infinity();
    return;
  }
  const double moved_s =
      std::clamp((before.Left_m2() - after.Left_m2()) / (2 * kLag_s) / curvature, -kLag_s, kLag_s);
  double scatter = 0;
  for (std::size_t b = 0; b < at.left_m2.size(); ++b) {
    const double slope = (after.left_m2[b] - before.left_m2[b]) / (2 * kLag_s);
    const double bend =
        (before.left_m2[b] - 2 * at.left_m2[b] + after.left_m2[b]) / kLag_s / kLag_s;
    scatter += std::pow(slope + bend * moved_s, 2);
  }
  found->lag_s += moved_s;
  found->sigma_s = std::sqrt(scatter) / curvature;
}

}  // namespace

bool PlanarPath::Covers(double t_s) const {
  const double place = (t_s - from_s) / step_s;
  return place >= 0 && place <= static_cast<double>(at_m.size()) - 1;
}

std::complex<double> PlanarPath::At(double t_s) const {
  const double place = (t_s - from_s) / step_s;
  const auto k = std::min(static_cast<std::size_t>(place), at_m.size() - 2);
  return at_m[k] + (place - static_cast<double>(k)) * (at_m[k + 1] - at_m[k]);
}

std::optional<PathLag> LagBehind(const PlanarPath& path, const std::vector<PlanarFix>& fixes,
                                 double near_s) {
  if (path.at_m.size() < 2 || fixes.size() < 2) return std::nullopt;
  const Comparison comparison(path, fixes);
  PathLag found;
  double most_m2 = 0;
  std::size_t tried = 0;
  for (const double lag_s : Lags()) {
    const Steps steps = comparison.PathWith(lag_s);
    if (comparison.CountOf(steps) < kFewestSteps) continue;
    ++tried;
    const Fit fit = comparison.FitOf(steps, comparison.all());
    const double explained_m2 = fit.share * fit.share * fit.power_m2;
    if (explained_m2 <= most_m2) continue;
    most_m2 = explained_m2;
    found.lag_s = lag_s;
    found.share = fit.share;
  }
  if (most_m2 <= 0) return std::nullopt;
  const Steps best = comparison.PathWith(found.lag_s);
  const Fit alone = comparison.FitOf(best, comparison.MaskOf(best, best));
  const double noise_m2 =
      std::max(kLeastNoise_m * kLeastNoise_m, kLoudest * alone.Left_m2() / alone.Degrees());
  Refine(comparison, &found);
  const double apart_s = std::max(kApart_s, kApartSigmas * found.sigma_s);
  double p = 0;
  for (const double lag_s : Lags()) {
    const bool is_near = std::abs(lag_s) <= near_s + kLag_s / 2;
    if (!is_near && std::abs(lag_s - found.lag_s) < apart_s) continue;
    const Steps other = comparison.PathWith(lag_s);
    const auto& mask = is_near ? comparison.MaskOf(best, other) : comparison.all();
    p = std::max(p, GainP(comparison.GainsOf(best, other, mask, noise_m2)));
  }
  found.p = std::min(1.0, p * std::max(1.0, static_cast<double>(tried) * kLag_s / kMean_s));
  const Steps unshifted = comparison.PathWith(0);
  const std::vector<char> both = comparison.MaskOf(best, unshifted);
  const Fit before = comparison.FitOf(unshifted, both), after = comparison.FitOf(best, both);
  const auto count = static_cast<double>(std::count(both.begin(), both.end(), 1));
  found.rms_before_m = std::sqrt(before.Left_m2() / std::max(1.0, count));
  found.rms_after_m = std::sqrt(after.Left_m2() / std::max(1.0, count));
  return found;
}

}  // namespace tera
