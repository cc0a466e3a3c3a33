#include "diagnose/perception/scans/sensor_search.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"
#include "diagnose/perception/scans/range_residuals.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

using Index = SensorNumbers::Index;

/// Bit k: mechanism k acts.
using Structure = unsigned;

constexpr std::size_t kPointsOfScan = 400;
constexpr double kChosen = 0.01, kConfirmed = 0.05;
constexpr double kLeastShare = 0.02;   ///< of the error
constexpr double kUndetermined = 0.3;  ///< of the prior: beyond it a number stays as it was
constexpr double kNearest = 0.95;
/// Starts for a wrong clock, s; 18: between GPS time and UTC.
constexpr double kOffsets_s[] = {0.1, -0.1, 0.3, -0.3, 1, -1, 3, -3, 18, -18};

/// One set of numbers, judged on scans that it was not fitted to.
struct Judged {
  SensorFit fit;
  std::vector<PointResidual> residuals;
};

class Search {
 public:
  Search(const SensorComparison& sensor, const std::vector<SensorMechanism>& mechanisms,
         const SearchedPoints& points)
      : sensor_(sensor),
        mechanisms_(mechanisms),
        points_(points),
        all_((1u << mechanisms.size()) - 1) {}

  SensorSearch Run() {
    SensorSearch result;
    result.numbers = sensor_.present;
    EstimateNoise(&result);
    const Structure chosen = Choose();
    Confirm(chosen, &result);
    return result;
  }

 private:
  FreeNumbers FreeOf(Structure structure) const {
    FreeNumbers is_free = {};
    for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
      if (!(structure >> m & 1u)) continue;
      for (const SensorMechanism::Number& number : mechanisms_[m].numbers)
        is_free[number.index] = true;
    }
    return is_free;
  }

  std::size_t CountOf(Structure structure) const {
    const FreeNumbers is_free = FreeOf(structure);
    return static_cast<std::size_t>(std::count(is_free.begin(), is_free.end(), true));
  }

  /// A fit, with what it could not tell put back and the rest fitted again.
  SensorFit Fit(const std::vector<ScanPoints>& points, Structure structure,
                const SensorNumbers& start) const {
    SensorNumbers from = start;
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      if (!FreeOf(structure)[i]) from.value[i] = sensor_.present.value[i];
    }
    FreeNumbers is_free = FreeOf(structure);
    SensorFit fit = FitSensor(sensor_, points, is_free, from, scale_);
    bool again = false;
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      if (!is_free[i] || fit.undetermined[i] < kUndetermined) continue;
      is_free[i] = false;
      from.value[i] = sensor_.present.value[i];
      again = true;
    }
    if (!again) return fit;
    const auto undetermined = fit.undetermined;
    fit = FitSensor(sensor_, points, is_free, from, scale_);
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      fit.undetermined[i] = std::max(fit.undetermined[i], undetermined[i]);
    }
    return fit;
  }

  std::vector<PointResidual> Residuals(const std::vector<ScanPoints>& points,
                                       const SensorNumbers& numbers) const {
    return sensor_.residuals(points, numbers, 0);
  }

  double LogLikelihood(const std::vector<PointResidual>& residuals) const {
    double sum = 0;
    for (const PointResidual& r : residuals) sum += LogLikelihoodOf(r, scale_);
    return sum;
  }

  /// The start with the clock that fits TRAIN best.
  SensorNumbers StartOfClock(const std::vector<PointResidual>& nothing) const {
    SensorNumbers best = sensor_.start;
    double moved = 0;
    for (const PointResidual& r : nothing) moved += std::abs(r.slope[Index::kOffset]);
    if (moved == 0) return best;
    std::vector<ScanPoints> some;
    for (std::size_t s = 0; s < points_.train.size(); s += 2) some.push_back(points_.train[s]);
    double highest = LogLikelihood(sensor_.residuals(some, best, sensor_.coarsest));
    for (const double offset_s : kOffsets_s) {
      SensorNumbers late = sensor_.start;
      late.value[Index::kOffset] += offset_s;
      const double likelihood = LogLikelihood(sensor_.residuals(some, late, sensor_.coarsest));
      if (likelihood <= highest) continue;
      highest = likelihood;
      best = late;
    }
    return best;
  }

  void EstimateNoise(SensorSearch* result) {
    nothing_ = Residuals(points_.train, sensor_.present);
    scale_ = 1;
    clock_start_ = StartOfClock(nothing_);
    const SensorFit all = Fit(points_.train, all_, clock_start_);
    const std::vector<PointResidual> left = Residuals(points_.train, all.numbers);
    scale_ = ScaleOf(left);
    result->scale = scale_;
    result->noise_rmse = TrimmedRmse(left);
    AddDetectability(left, all, result);
  }

  void AddDetectability(const std::vector<PointResidual>& left, const SensorFit& all,
                        SensorSearch* result) const {
    Eigen::Matrix<double, SensorNumbers::kCount, 1> square;
    square.setZero();
    double judged = 0;
    for (const PointResidual& r : left) {
      if (!r.is_judged()) continue;
      judged += 1;
      square += (r.slope / (scale_ * r.sigma)).cwiseAbs2();
    }
    for (const SensorMechanism& mechanism : mechanisms_) {
      for (const SensorMechanism::Number& number : mechanism.numbers) {
        SensorDetectability one{mechanism.id, number.name, number.unit, {}};
        const bool tells =
            square[number.index] > 0 && all.undetermined[number.index] < kUndetermined;
        if (tells) {
          one.smallest = number.factor * std::sqrt(2 * kLeastShare * judged / square[number.index]);
        }
        result->detectability.push_back(one);
      }
    }
  }

  const Judged& OnSelect(Structure structure) {
    const auto at = on_select_.find(structure);
    if (at != on_select_.end()) return at->second;
    Judged judged;
    const SensorNumbers& start = FreeOf(structure)[Index::kOffset] ? clock_start_ : sensor_.start;
    if (structure)
      judged.fit = Fit(points_.train, structure, start);
    else
      judged.fit.numbers = sensor_.present;
    judged.residuals = Residuals(points_.select, judged.fit.numbers);
    return on_select_.emplace(structure, std::move(judged)).first->second;
  }

  /// Of the second over the first, one number a block of time.
  std::vector<ManoeuvreGain> Gains(const std::vector<PointResidual>& before,
                                   const std::vector<PointResidual>& after) const {
    std::map<std::size_t, ManoeuvreGain> gains;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].out_of_picture || after[i].out_of_picture) continue;
      ManoeuvreGain& gain = gains[points_.block[before[i].scan]];
      gain.gain += LogLikelihoodOf(after[i], scale_) - LogLikelihoodOf(before[i], scale_);
      const bool both = before[i].is_judged() && after[i].is_judged();
      const double apart = both ? after[i].beyond - before[i].beyond : 0;
      gain.possible -= LogDensityAt(apart / (scale_ * before[i].sigma));
    }
    std::vector<ManoeuvreGain> list;
    for (const auto& [block, gain] : gains) list.push_back(gain);
    return list;
  }

  double P(const std::vector<PointResidual>& before,
           const std::vector<PointResidual>& after) const {
    return SteadyGainP(Gains(before, after));
  }

  /// Whether `more` is steadily and noticeably better than `less`.
  bool IsBetter(Structure less, Structure more) {
    const auto& before = OnSelect(less).residuals;
    const auto& after = OnSelect(more).residuals;
    if (P(before, after) > kChosen / static_cast<double>(mechanisms_.size())) return false;
    return TrimmedRmse(after) <= (1 - kLeastShare) * TrimmedRmse(before);
  }

  /// The best of some structures on SELECT; of those that are not steadily worse than it, the one
  /// of the fewest numbers.
  Structure BestOf(const std::vector<Structure>& candidates) {
    Structure best = candidates.front();
    for (const Structure s : candidates) {
      if (LogLikelihood(OnSelect(s).residuals) > LogLikelihood(OnSelect(best).residuals)) best = s;
    }
    Structure simplest = best;
    for (const Structure s : candidates) {
      if (CountOf(s) < CountOf(simplest) && !IsBetter(s, best)) simplest = s;
    }
    return simplest;
  }

  Structure Choose() {
    if (!IsBetter(0, all_)) return 0;
    Structure chosen = 0;
    while (chosen != all_) {
      std::vector<Structure> candidates;
      for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
        if (!(chosen >> m & 1u)) candidates.push_back(chosen | 1u << m);
      }
      const Structure next = BestOf(candidates);
      if (!IsBetter(chosen, next)) break;
      chosen = next;
    }
    for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
      const Structure without = chosen & ~(1u << m);
      if (without != chosen && !IsBetter(without, chosen)) chosen = without;
    }
    return chosen;
  }

  std::vector<std::string_view> RivalsOf(Structure chosen, std::size_t m) {
    std::vector<std::string_view> rivals = {mechanisms_[m].id};
    for (std::size_t other = 0; other < mechanisms_.size(); ++other) {
      if (chosen >> other & 1u) continue;
      const Structure swapped = (chosen & ~(1u << m)) | 1u << other;
      if (!IsBetter(swapped, chosen)) rivals.push_back(mechanisms_[other].id);
    }
    return rivals;
  }

  void AddParameters(std::size_t m, const SensorFit& fit, SensorFinding* finding) const {
    for (const SensorMechanism::Number& number : mechanisms_[m].numbers) {
      ParameterEstimate estimate;
      estimate.name = number.name;
      estimate.unit = number.unit;
      estimate.value = number.factor * fit.numbers.value[number.index];
      if (fit.undetermined[number.index] < kUndetermined) {
        estimate.sigma = number.factor * fit.sigma[number.index];
      }
      finding->parameters.push_back(estimate);
      finding->present.push_back(number.factor * sensor_.present.value[number.index]);
    }
  }

  void Confirm(Structure chosen, SensorSearch* result) {
    if (!chosen) return;
    const SensorFit fit = Fit(points_.seen, chosen, OnSelect(chosen).fit.numbers);
    const std::vector<PointResidual> with = Residuals(points_.final, fit.numbers);
    Structure confirmed = 0;
    for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
      if (!(chosen >> m & 1u)) continue;
      const Structure rest = chosen & ~(1u << m);
      SensorFit without{sensor_.present, {}, {}};
      if (rest) without = Fit(points_.seen, rest, OnSelect(rest).fit.numbers);
      const std::vector<PointResidual> before = Residuals(points_.final, without.numbers);
      SensorFinding finding;
      finding.mechanism = mechanisms_[m].id;
      finding.rivals = RivalsOf(chosen, m);
      finding.p_chosen = P(OnSelect(rest).residuals, OnSelect(chosen).residuals);
      finding.p_confirmed = P(before, with);
      finding.rmse_before = TrimmedRmse(before);
      finding.rmse_after = TrimmedRmse(with);
      AddParameters(m, fit, &finding);
      const bool holds = finding.p_confirmed <= kConfirmed;
      if (holds) confirmed |= 1u << m;
      (holds ? result->findings : result->unconfirmed).push_back(std::move(finding));
    }
    if (confirmed == chosen)
      result->numbers = fit.numbers;
    else if (confirmed)
      result->numbers = Fit(points_.seen, confirmed, fit.numbers).numbers;
  }

  const SensorComparison& sensor_;
  const std::vector<SensorMechanism>& mechanisms_;
  const SearchedPoints& points_;
  const Structure all_;
  double scale_ = 1;
  std::vector<PointResidual> nothing_;
  SensorNumbers clock_start_;
  std::map<Structure, Judged> on_select_;
};

}  // namespace

SensorMechanism OfMount() {
  return {"extrinsic",
          {{Index::kX, "x_m", "m", 1},
           {Index::kY, "y_m", "m", 1},
           {Index::kZ, "z_m", "m", 1},
           {Index::kRoll, "roll_deg", "deg", 1 / kDeg},
           {Index::kPitch, "pitch_deg", "deg", 1 / kDeg},
           {Index::kYaw, "yaw_deg", "deg", 1 / kDeg}}};
}

SensorMechanism OfClock() { return {"clock_offset", {{Index::kOffset, "offset_s", "s", 1}}}; }

std::vector<SensorMechanism> MechanismsOf(const RangeSource& source) {
  const bool depth = source.planar_depth;
  return {OfMount(),
          {"range_bias", {{Index::kRange, depth ? "depth_m" : "range_m", "m", 1}}},
          {"scale", {{Index::kFactor, depth ? "depth_factor" : "range_factor", "1", 1}}},
          OfClock()};
}

SearchedPoints PointsToSearch(const RangeSource& source, const ScanSplit& split,
                              const std::vector<std::vector<bool>>& left_out) {
  const auto points = [&](const std::vector<Part>& parts) {
    return PointsOf(source.scans, split, parts, kPointsOfScan, left_out);
  };
  return PointsToSearch(split, points);
}

SearchedPoints PointsToSearch(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points) {
  return {points({Part::kTrain}), points({Part::kSelect}), points({Part::kTrain, Part::kSelect}),
          points({Part::kFinal}), split.block};
}

SensorSearch SearchSensor(const SensorComparison& sensor,
                          const std::vector<SensorMechanism>& mechanisms,
                          const SearchedPoints& points) {
  return Search(sensor, mechanisms, points).Run();
}

SensorSearch SearchSensor(const RangeSource& source, const ScanSplit& split,
                          const std::vector<std::vector<bool>>& left_out) {
  return SearchSensor(ComparisonOf(source), MechanismsOf(source),
                      PointsToSearch(source, split, left_out));
}

double TrimmedRmse(const std::vector<PointResidual>& residuals) {
  std::vector<double> square;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) square.push_back(r.beyond * r.beyond);
  }
  if (square.empty()) return 0;
  const auto kept =
      static_cast<std::size_t>(std::ceil(kNearest * static_cast<double>(square.size())));
  std::nth_element(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(kept) - 1,
                   square.end());
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += square[i];
  return std::sqrt(sum / static_cast<double>(kept));
}

}  // namespace tera
