#include "diagnose/perception/registration/registration_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "diagnose/perception/registration/registration_fit.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

constexpr double kLeastReduction = 0.02;  ///< least relative reduction of the error by a term

/// Ascending indices of candidates.
using Subset = std::vector<std::size_t>;

bool Has(const Subset& subset, std::size_t candidate) {
  return std::binary_search(subset.begin(), subset.end(), candidate);
}

Subset With(Subset subset, std::size_t candidate) {
  subset.insert(std::upper_bound(subset.begin(), subset.end(), candidate), candidate);
  return subset;
}

Subset Less(Subset subset, std::size_t candidate) {
  std::erase(subset, candidate);
  return subset;
}

/// A structure fitted to TRAIN, with its residuals on SELECT.
struct Judged {
  Structure terms;
  std::vector<PointResidual> residuals;
};

class Search {
 public:
  Search(const RegistrationBlock& block, const SplitPoints& points, const Structure& start)
      : block_(block), points_(points) {
    for (std::size_t c = 0; c < block.candidates.size(); ++c) all_.push_back(c);
    SetStarts(start);
  }

  RegistrationSearch Run() {
    RegistrationSearch result;
    EstimateNoise(&result);
    Confirm(Choose(), &result);
    result.calibration = block_.Under(result.found);
    return result;
  }

 private:
  /// Terms of a subset at their starting values.
  Structure StartOf(const Subset& subset) const {
    Structure terms;
    for (const std::size_t c : subset) terms.push_back(starts_[c]);
    return terms;
  }

  std::size_t CountParameters(const Subset& subset) const {
    std::size_t count = 0;
    for (const std::size_t c : subset) count += block_.candidates[c].free.size();
    return count;
  }

  std::vector<PointResidual> Residuals(const std::vector<ScanPoints>& points,
                                       const Structure& terms, int level = 0) const {
    return block_.residuals(points, block_.Under(terms), level);
  }

  /// Sets each candidate's starting values: from `given`, or from the scenario. The candidate's own
  /// starts replace them if they are likelier, on every other scan of TRAIN at the coarsest level.
  void SetStarts(const Structure& given) {
    for (const Candidate& candidate : block_.candidates) {
      Term term{&candidate,
                candidate.present.empty() ? candidate.starts.front() : candidate.present};
      for (const Term& one : given) {
        if (one.candidate == &candidate) term.values = one.values;
      }
      starts_.push_back(std::move(term));
    }
    const std::vector<PointResidual> nothing = Residuals(points_.train, {});
    std::vector<ScanPoints> some;
    for (std::size_t s = 0; s < points_.train.size(); s += 2) some.push_back(points_.train[s]);
    const double at_given = LogLikelihoodOf(Residuals(some, given, block_.coarsest), scale_);
    for (Term& term : starts_) {
      if (term.candidate->starts.size() < 2 || !ChangesAny(nothing, term)) continue;
      double highest = at_given;
      for (const std::vector<double>& values : term.candidate->starts) {
        Structure tried = given;
        std::erase_if(tried, [&](const Term& one) { return one.candidate == term.candidate; });
        tried.push_back({term.candidate, values});
        const double likelihood = LogLikelihoodOf(Residuals(some, tried, block_.coarsest), scale_);
        if (likelihood <= highest) continue;
        highest = likelihood;
        term.values = values;
      }
    }
  }

  /// True if a term changes any residual. A clock offset changes none if nothing moves.
  bool ChangesAny(const std::vector<PointResidual>& residuals, const Term& term) const {
    const CalibrationJacobian jacobian = JacobianOf(block_.X_BS, block_.present, {term});
    return std::any_of(residuals.begin(), residuals.end(), [&](const PointResidual& residual) {
      return (jacobian.transpose() * residual.by_calibration).cwiseAbs().sum() > 0;
    });
  }

  void EstimateNoise(RegistrationSearch* result) {
    const RegistrationFit fit = FitRegistration(block_, points_.train, StartOf(all_), scale_);
    const std::vector<PointResidual> left = Residuals(points_.train, fit.terms);
    scale_ = ScaleOf(left);
    noise_rmse_ = TrimmedRmse(left);
    result->scale = scale_;
    result->noise_rmse = noise_rmse_;
    AddDetectability(left, fit, result);
  }

  /// Adds the detectable deviation of each parameter. Such a deviation raises the mean square
  /// residual as much as a term must reduce it (kLeastReduction).
  void AddDetectability(const std::vector<PointResidual>& left, const RegistrationFit& all,
                        RegistrationSearch* result) const {
    CalibrationMatrix information = CalibrationMatrix::Zero();
    double judged = 0;
    for (const PointResidual& r : left) {
      if (!r.is_judged()) continue;
      judged += 1;
      const CalibrationVector slope = r.by_calibration / (scale_ * r.sigma);
      information += slope * slope.transpose();
    }
    Structure terms = all.terms;
    for (Term& term : terms) term.held.clear();
    const CalibrationJacobian jacobian = JacobianOf(block_.X_BS, block_.present, terms);
    Eigen::Index column = 0;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      for (const FreeParameter& free : terms[t].candidate->free) {
        const CalibrationVector derivative = jacobian.col(column++);
        const double square = derivative.dot(information * derivative);
        ParameterDetectability one{terms[t].candidate, free.index, {}};
        if (square > 0 && all.precision[t][free.index].is_determined()) {
          one.smallest = std::sqrt(2 * kLeastReduction * judged / square);
        }
        result->detectability.push_back(one);
      }
    }
  }

  const Judged& OnSelect(const Subset& subset) {
    const auto at = on_select_.find(subset);
    if (at != on_select_.end()) return at->second;
    Judged judged;
    if (!subset.empty()) {
      judged.terms = FitRegistration(block_, points_.train, StartOf(subset), scale_).terms;
    }
    judged.residuals = Residuals(points_.select, judged.terms);
    return on_select_.emplace(subset, std::move(judged)).first->second;
  }

  /// Gains in log-likelihood of `after` over `before`, one per block of time.
  std::vector<ManoeuvreGain> GainsOf(const std::vector<PointResidual>& before,
                                     const std::vector<PointResidual>& after) const {
    std::map<std::size_t, ManoeuvreGain> gains;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].out_of_picture || after[i].out_of_picture) continue;
      ManoeuvreGain& gain = gains[points_.block[before[i].scan]];
      gain.gain += LogLikelihoodOf(after[i], scale_) - LogLikelihoodOf(before[i], scale_);
      const bool both = before[i].is_judged() && after[i].is_judged();
      const double apart = both ? after[i].distance - before[i].distance : 0;
      gain.possible -= LogDensityAt(apart / (scale_ * before[i].sigma));
    }
    std::vector<ManoeuvreGain> list;
    for (const auto& [block, gain] : gains) list.push_back(gain);
    return list;
  }

  double GainP(const std::vector<PointResidual>& before,
               const std::vector<PointResidual>& after) const {
    return SteadyGainP(GainsOf(before, after));
  }

  /// p-value of the gain of `more` over `less` on SELECT, with Bonferroni's correction over the
  /// candidates.
  double ChosenP(const Subset& less, const Subset& more) {
    const double p = GainP(OnSelect(less).residuals, OnSelect(more).residuals);
    return std::min(1.0, p * static_cast<double>(block_.candidates.size()));
  }

  /// True if `more` has a steady gain over `less` and a noticeably smaller error.
  bool IsBetter(const Subset& less, const Subset& more) {
    if (ChosenP(less, more) > options_.alpha) return false;
    return TrimmedRmse(OnSelect(more).residuals) <=
           (1 - kLeastReduction) * TrimmedRmse(OnSelect(less).residuals);
  }

  /// Subset with the greatest likelihood on SELECT. A subset with fewer parameters is preferred if
  /// the likeliest is not better (IsBetter).
  Subset BestOf(const std::vector<Subset>& subsets) {
    const auto likelihood = [&](const Subset& subset) {
      return LogLikelihoodOf(OnSelect(subset).residuals, scale_);
    };
    Subset best = subsets.front();
    for (const Subset& subset : subsets) {
      if (likelihood(subset) > likelihood(best)) best = subset;
    }
    Subset simplest = best;
    for (const Subset& subset : subsets) {
      if (CountParameters(subset) < CountParameters(simplest) && !IsBetter(subset, best)) {
        simplest = subset;
      }
    }
    return simplest;
  }

  /// Forward selection while it improves, then removal of superfluous terms.
  Subset Choose() {
    if (!IsBetter({}, all_)) return {};
    Subset chosen;
    while (chosen != all_) {
      std::vector<Subset> larger;
      for (const std::size_t c : all_) {
        if (!Has(chosen, c)) larger.push_back(With(chosen, c));
      }
      Subset next = BestOf(larger);
      if (!IsBetter(chosen, next)) break;
      chosen = std::move(next);
    }
    for (const std::size_t c : all_) {
      const Subset without = Less(chosen, c);
      if (without != chosen && !IsBetter(without, chosen)) chosen = without;
    }
    return chosen;
  }

  /// Candidates that could replace a selected one without a worse result. The selected one comes
  /// first.
  std::vector<const Candidate*> RivalsOf(const Subset& chosen, std::size_t candidate) {
    std::vector<const Candidate*> rivals = {&block_.candidates[candidate]};
    for (const std::size_t other : all_) {
      if (Has(chosen, other)) continue;
      if (!IsBetter(With(Less(chosen, candidate), other), chosen)) {
        rivals.push_back(&block_.candidates[other]);
      }
    }
    return rivals;
  }

  /// Fit to TRAIN and SELECT, started from the fit to TRAIN.
  RegistrationFit FitToSeen(const Subset& subset) {
    Structure start = OnSelect(subset).terms;
    for (Term& term : start) term.held.clear();
    return FitRegistration(block_, points_.seen, start, scale_);
  }

  static std::vector<ParameterEstimate> EstimatesOf(const RegistrationFit& fit, std::size_t term) {
    std::vector<ParameterEstimate> estimates;
    const std::vector<EffectParameter>& parameters =
        fit.terms[term].candidate->mechanism->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      estimates.push_back({std::string(parameters[i].name),
                           std::string(parameters[i].unit),
                           fit.terms[term].values[i],
                           {}});
      const ParameterPrecision& precision = fit.precision[term][i];
      if (precision.is_determined()) estimates.back().sigma = precision.sigma;
    }
    return estimates;
  }

  void Confirm(const Subset& chosen, RegistrationSearch* result) {
    if (chosen.empty()) return;
    const RegistrationFit fit = FitToSeen(chosen);
    const std::vector<PointResidual> with = Residuals(points_.final, fit.terms);
    Structure confirmed;
    for (std::size_t t = 0; t < chosen.size(); ++t) {
      const Subset rest = Less(chosen, chosen[t]);
      Structure without;
      if (!rest.empty()) without = FitToSeen(rest).terms;
      const std::vector<PointResidual> before = Residuals(points_.final, without);
      Finding finding;
      finding.term = fit.terms[t];
      finding.parameters = EstimatesOf(fit, t);
      finding.evidence.rivals = RivalsOf(chosen, chosen[t]);
      finding.evidence.p = finding.evidence.steady_p = ChosenP(rest, chosen);
      finding.held_out.p = GainP(before, with);
      finding.held_out.rmse_before = TrimmedRmse(before);
      finding.held_out.rmse_after = TrimmedRmse(with);
      finding.held_out.excess_removed = ExcessRemoved(finding.held_out, noise_rmse_);
      finding.is_confirmed = finding.held_out.p <= kConfirmedP;
      if (finding.is_confirmed) confirmed.push_back(fit.terms[t]);
      (finding.is_confirmed ? result->findings : result->unconfirmed).push_back(std::move(finding));
    }
    result->found = confirmed;
    if (confirmed.empty() || confirmed.size() == chosen.size()) return;
    for (Term& term : confirmed) term.held.clear();
    result->found = FitRegistration(block_, points_.seen, confirmed, scale_).terms;
  }

  const RegistrationBlock& block_;
  const SplitPoints& points_;
  const SearchOptions options_;
  Subset all_;
  Structure starts_;  ///< one per candidate
  double scale_ = 1, noise_rmse_ = 0;
  std::map<Subset, Judged> on_select_;
};

}  // namespace

double ExcessRemoved(const HeldOutError& error, double noise_rmse) {
  const double before = error.rmse_before * error.rmse_before;
  const double excess = before - noise_rmse * noise_rmse;
  if (excess <= 0) return 0;
  return std::clamp((before - error.rmse_after * error.rmse_after) / excess, 0.0, 1.0);
}

SplitPoints PointsOfParts(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points) {
  return {points({Part::kTrain}), points({Part::kSelect}), points({Part::kTrain, Part::kSelect}),
          points({Part::kFinal}), split.block};
}

RegistrationSearch SearchRegistration(const RegistrationBlock& block, const SplitPoints& points,
                                      const Structure& start) {
  return Search(block, points, start).Run();
}

}  // namespace tera
