#include "diagnose/perception/sensor_search.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"
#include "diagnose/search/steady_gain.h"

namespace tera {
namespace {

using Index = SensorNumbers::Index;

struct NumberOfMechanism {
  Index index;
  std::string_view name, unit;
  double factor;  ///< from SI
};

struct SensorMechanism {
  std::string_view id;
  std::vector<NumberOfMechanism> numbers;
};

std::vector<SensorMechanism> MechanismsOf(const RangeSource& source) {
  const bool depth = source.planar_depth;
  return {{"extrinsic",
           {{Index::kX, "x_m", "m", 1},
            {Index::kY, "y_m", "m", 1},
            {Index::kZ, "z_m", "m", 1},
            {Index::kRoll, "roll_deg", "deg", 1 / kDeg},
            {Index::kPitch, "pitch_deg", "deg", 1 / kDeg},
            {Index::kYaw, "yaw_deg", "deg", 1 / kDeg}}},
          {"range_bias", {{Index::kRange, depth ? "depth_m" : "range_m", "m", 1}}},
          {"scale", {{Index::kFactor, depth ? "depth_factor" : "range_factor", "1", 1}}},
          {"clock_offset", {{Index::kOffset, "offset_s", "s", 1}}}};
}

/// Bit k: mechanism k acts.
using Structure = unsigned;
constexpr std::size_t kMechanisms = 4;
constexpr Structure kAll = (1u << kMechanisms) - 1, kClock = 1u << 3;

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
  Search(const RangeSource& source, const ScanSplit& split,
         const std::vector<std::vector<bool>>& left_out)
      : source_(source), split_(split), mechanisms_(MechanismsOf(source)) {
    const auto points = [&](const std::vector<Part>& parts) {
      return PointsOf(source.scans, split, parts, kPointsOfScan, left_out);
    };
    train_ = points({Part::kTrain});
    select_ = points({Part::kSelect});
    seen_ = points({Part::kTrain, Part::kSelect});
    final_ = points({Part::kFinal});
  }

  SensorSearch Run() {
    SensorSearch result;
    result.numbers = source_.present;
    EstimateNoise(&result);
    const Structure chosen = Choose();
    Confirm(chosen, &result);
    return result;
  }

 private:
  FreeNumbers FreeOf(Structure structure) const {
    FreeNumbers is_free = {};
    for (std::size_t m = 0; m < kMechanisms; ++m) {
      if (!(structure >> m & 1u)) continue;
      for (const NumberOfMechanism& number : mechanisms_[m].numbers) is_free[number.index] = true;
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
      if (!FreeOf(structure)[i]) from.value[i] = source_.present.value[i];
    }
    FreeNumbers is_free = FreeOf(structure);
    SensorFit fit = FitSensor(source_, points, is_free, from, scale_);
    bool again = false;
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      if (!is_free[i] || fit.undetermined[i] < kUndetermined) continue;
      is_free[i] = false;
      again = true;
    }
    if (!again) return fit;
    const auto undetermined = fit.undetermined;
    fit = FitSensor(source_, points, is_free, from, scale_);
    for (std::size_t i = 0; i < SensorNumbers::kCount; ++i) {
      fit.undetermined[i] = std::max(fit.undetermined[i], undetermined[i]);
    }
    return fit;
  }

  double LogLikelihood(const std::vector<PointResidual>& residuals) const {
    double sum = 0;
    for (const PointResidual& r : residuals) sum += LogLikelihoodOf(r, scale_);
    return sum;
  }

  /// The present numbers with the clock that fits TRAIN best.
  SensorNumbers StartOfClock(const std::vector<PointResidual>& nothing) const {
    SensorNumbers best = source_.present;
    double moved = 0;
    for (const PointResidual& r : nothing) moved += std::abs(r.slope[Index::kOffset]);
    if (moved == 0) return best;
    std::vector<ScanPoints> some;
    for (std::size_t s = 0; s < train_.size(); s += 2) some.push_back(train_[s]);
    double highest = LogLikelihood(ResidualsOf(source_, some, best));
    for (const double offset_s : kOffsets_s) {
      SensorNumbers late = source_.present;
      late.value[Index::kOffset] += offset_s;
      const double likelihood = LogLikelihood(ResidualsOf(source_, some, late));
      if (likelihood <= highest) continue;
      highest = likelihood;
      best = late;
    }
    return best;
  }

  void EstimateNoise(SensorSearch* result) {
    nothing_ = ResidualsOf(source_, train_, source_.present);
    scale_ = 1;
    clock_start_ = StartOfClock(nothing_);
    const SensorFit all = Fit(train_, kAll, clock_start_);
    const std::vector<PointResidual> left = ResidualsOf(source_, train_, all.numbers);
    scale_ = ScaleOf(left);
    result->scale = scale_;
    result->noise_rmse_m = TrimmedRmse_m(left);
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
      square += (r.slope / (scale_ * r.sigma_m)).cwiseAbs2();
    }
    for (const SensorMechanism& mechanism : mechanisms_) {
      for (const NumberOfMechanism& number : mechanism.numbers) {
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
    const SensorNumbers& start = structure & kClock ? clock_start_ : source_.present;
    if (structure)
      judged.fit = Fit(train_, structure, start);
    else
      judged.fit.numbers = source_.present;
    judged.residuals = ResidualsOf(source_, select_, judged.fit.numbers);
    return on_select_.emplace(structure, std::move(judged)).first->second;
  }

  /// Of the second over the first, one number a block of time.
  std::vector<ManoeuvreGain> Gains(const std::vector<PointResidual>& before,
                                   const std::vector<PointResidual>& after) const {
    std::map<std::size_t, ManoeuvreGain> gains;
    for (std::size_t i = 0; i < before.size(); ++i) {
      ManoeuvreGain& gain = gains[split_.block[before[i].scan]];
      gain.gain += LogLikelihoodOf(after[i], scale_) - LogLikelihoodOf(before[i], scale_);
      const bool both = before[i].is_judged() && after[i].is_judged();
      const double apart_m = both ? after[i].beyond_m - before[i].beyond_m : 0;
      gain.possible -= LogDensityAt(apart_m / (scale_ * before[i].sigma_m));
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
    if (P(before, after) > kChosen / kMechanisms) return false;
    return TrimmedRmse_m(after) <= (1 - kLeastShare) * TrimmedRmse_m(before);
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
    if (!IsBetter(0, kAll)) return 0;
    Structure chosen = 0;
    while (chosen != kAll) {
      std::vector<Structure> candidates;
      for (std::size_t m = 0; m < kMechanisms; ++m) {
        if (!(chosen >> m & 1u)) candidates.push_back(chosen | 1u << m);
      }
      const Structure next = BestOf(candidates);
      if (!IsBetter(chosen, next)) break;
      chosen = next;
    }
    for (std::size_t m = 0; m < kMechanisms; ++m) {
      const Structure without = chosen & ~(1u << m);
      if (without != chosen && !IsBetter(without, chosen)) chosen = without;
    }
    return chosen;
  }

  std::vector<std::string_view> RivalsOf(Structure chosen, std::size_t m) {
    std::vector<std::string_view> rivals = {mechanisms_[m].id};
    for (std::size_t other = 0; other < kMechanisms; ++other) {
      if (chosen >> other & 1u) continue;
      const Structure swapped = (chosen & ~(1u << m)) | 1u << other;
      if (!IsBetter(swapped, chosen)) rivals.push_back(mechanisms_[other].id);
    }
    return rivals;
  }

  void AddParameters(std::size_t m, const SensorFit& fit, SensorFinding* finding) const {
    for (const NumberOfMechanism& number : mechanisms_[m].numbers) {
      ParameterEstimate estimate;
      estimate.name = number.name;
      estimate.unit = number.unit;
      estimate.value = number.factor * fit.numbers.value[number.index];
      if (fit.undetermined[number.index] < kUndetermined) {
        estimate.sigma = number.factor * fit.sigma[number.index];
      }
      finding->parameters.push_back(estimate);
      finding->present.push_back(number.factor * source_.present.value[number.index]);
    }
  }

  void Confirm(Structure chosen, SensorSearch* result) {
    if (!chosen) return;
    const SensorFit fit = Fit(seen_, chosen, OnSelect(chosen).fit.numbers);
    const std::vector<PointResidual> with = ResidualsOf(source_, final_, fit.numbers);
    Structure confirmed = 0;
    for (std::size_t m = 0; m < kMechanisms; ++m) {
      if (!(chosen >> m & 1u)) continue;
      const Structure rest = chosen & ~(1u << m);
      SensorFit without{source_.present, {}, {}};
      if (rest) without = Fit(seen_, rest, OnSelect(rest).fit.numbers);
      const std::vector<PointResidual> before = ResidualsOf(source_, final_, without.numbers);
      SensorFinding finding;
      finding.mechanism = mechanisms_[m].id;
      finding.rivals = RivalsOf(chosen, m);
      finding.p_chosen = P(OnSelect(rest).residuals, OnSelect(chosen).residuals);
      finding.p_confirmed = P(before, with);
      finding.rmse_before_m = TrimmedRmse_m(before);
      finding.rmse_after_m = TrimmedRmse_m(with);
      AddParameters(m, fit, &finding);
      const bool holds = finding.p_confirmed <= kConfirmed;
      if (holds) confirmed |= 1u << m;
      (holds ? result->findings : result->unconfirmed).push_back(std::move(finding));
    }
    if (confirmed == chosen)
      result->numbers = fit.numbers;
    else if (confirmed)
      result->numbers = Fit(seen_, confirmed, fit.numbers).numbers;
  }

  const RangeSource& source_;
  const ScanSplit& split_;
  std::vector<SensorMechanism> mechanisms_;
  std::vector<ScanPoints> train_, select_, seen_, final_;
  double scale_ = 1;
  std::vector<PointResidual> nothing_;
  SensorNumbers clock_start_;
  std::map<Structure, Judged> on_select_;
};

}  // namespace

SensorSearch SearchSensor(const RangeSource& source, const ScanSplit& split,
                          const std::vector<std::vector<bool>>& left_out) {
  return Search(source, split, left_out).Run();
}

double TrimmedRmse_m(const std::vector<PointResidual>& residuals) {
  std::vector<double> square;
  for (const PointResidual& r : residuals) {
    if (r.is_judged()) square.push_back(r.beyond_m * r.beyond_m);
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
