#include "diagnose/learned/learn.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/regime/regime_axis.h"

namespace tera {
namespace {

constexpr double kLeastShare = -1, kMostShare = 9;
constexpr double kLongestGap = 0.25;  ///< of the range, over which a curve is believed
/// RMSE on SELECT over that of the effect over the located variable, at most, for another to be
/// learned.
constexpr double kMostOtherRatio = 0.9;
/// Share of FINAL's RMSE that a learned effect must remove.
constexpr double kLeastGain = 0.05;

class Learner {
 public:
  Learner(const ReplayBlock& block, const BlockDiagnosis& diagnosis, std::size_t channel);

  std::optional<Learned> Run(const Stream& stream) const;

 private:
  const LearnedVariable* Known(const std::string& name) const;
  std::optional<LearnedEffect> OfCurve(const std::vector<RegimeVariable>& variables,
                                       const Stream& stream) const;
  std::vector<LearnedEffect> Candidates(const Stream& stream) const;
  Series Left(const LearnedEffect& effect) const;
  double RmsOn(Part part, const Series& left) const {
    return std::sqrt(MeanSquare(left, MaskOf(diagnosis_.manoeuvres, part, left.size())));
  }

  const ReplayBlock& block_;
  const BlockDiagnosis& diagnosis_;
  std::size_t channel_;
  const std::vector<double> predicted_;
  Series residual_;  ///< measured less predicted, where the fit had both
};

Learner::Learner(const ReplayBlock& block, const BlockDiagnosis& diagnosis, std::size_t channel)
    : block_(block),
      diagnosis_(diagnosis),
      channel_(channel),
      predicted_(block.predict(diagnosis.search.found.terms)[channel]),
      residual_(block.channels[channel].measured) {
  residual_.valid = diagnosis.search.found.misfit.residual[channel].valid;
  for (std::size_t k = 0; k < predicted_.size(); ++k) residual_.value[k] -= predicted_[k];
}

const LearnedVariable* Learner::Known(const std::string& name) const {
  const auto at = std::find_if(block_.learnable.begin(), block_.learnable.end(),
                               [&](const LearnedVariable& one) { return one.name == name; });
  return at != block_.learnable.end() ? &*at : nullptr;
}

/// The best curve over one of some variables, all of which a simulation knows.
std::optional<LearnedEffect> Learner::OfCurve(const std::vector<RegimeVariable>& variables,
                                              const Stream& stream) const {
  const auto curve = FitCurve(diagnosis_.manoeuvres, variables, residual_, predicted_, stream);
  if (!curve) return std::nullopt;
  const auto variable =
      std::find_if(variables.begin(), variables.end(),
                   [&](const RegimeVariable& one) { return one.name == curve->variable; });
  std::vector<double> seen;
  for (const Segment& samples : SeenSegmentsOf(diagnosis_.manoeuvres)) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) {
      if (residual_.valid[k]) seen.push_back(variable->series.value[k]);
    }
  }
  return TabulatedCurve(*curve, *Known(curve->variable), std::move(seen));
}

/// Residual of the replay with an effect.
Series Learner::Left(const LearnedEffect& effect) const {
  const std::vector<double> change =
      block_.change_by_learned(diagnosis_.search.found.terms, effect)[channel_];
  Series left = residual_;
  for (std::size_t k = 0; k < left.size(); ++k) left.value[k] -= change[k];
  return left;
}

/// The effects that may run, that over the variable of the error's location first.
std::vector<LearnedEffect> Learner::Candidates(const Stream& stream) const {
  std::vector<RegimeVariable> known;
  for (const RegimeVariable& variable : block_.channels[channel_].variables) {
    if (Known(variable.name) != nullptr) known.push_back(variable);
  }
  std::vector<LearnedEffect> candidates;
  const auto add = [&](const std::vector<RegimeVariable>& variables) {
    if (auto effect = OfCurve(variables, stream)) candidates.push_back(std::move(*effect));
  };
  for (const Unexplained& left : diagnosis_.unexplained) {
    if (left.location.channel != channel_ || left.location.regimes.empty()) continue;
    for (const RegimeVariable& variable : known) {
      if (variable.name == left.location.regimes.front().variable) add({variable});
    }
  }
  add(known);
  return candidates;
}

std::optional<Learned> Learner::Run(const Stream& stream) const {
  std::optional<LearnedEffect> best;
  double least = 0;
  for (LearnedEffect& one : Candidates(stream)) {
    const double rmse = RmsOn(Part::kSelect, Left(one));
    if (best && rmse >= kMostOtherRatio * least) continue;
    best = std::move(one);
    least = rmse;
  }
  if (!best) return std::nullopt;
  Learned learned{channel_, *best, RmsOn(Part::kFinal, residual_),
                  RmsOn(Part::kFinal, Left(*best))};
  const bool holds = learned.rmse_after <= (1 - kLeastGain) * learned.rmse_before;
  return holds ? std::optional(std::move(learned)) : std::nullopt;
}

}  // namespace

LearnedEffect TabulatedCurve(const FittedCurve& curve, const LearnedVariable& variable,
                             std::vector<double> seen) {
  LearnedEffect learned{variable, curve.is_share, {}, {}, {}, {}};
  std::sort(seen.begin(), seen.end());
  const double longest = kLongestGap * (curve.at[curve.at.size() - 1] - curve.at[0]);
  const auto limit = [&](double value) {
    return curve.is_share ? std::clamp(value, kLeastShare, kMostShare) : value;
  };
  for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
    const double x = curve.at[b];
    const auto above = std::lower_bound(seen.begin(), seen.end(), x);
    const double from = above == seen.begin() ? curve.at[0] : *(above - 1);
    const double to = above == seen.end() ? curve.at[curve.at.size() - 1] : *above;
    const bool is_seen = above != seen.end() && *above == x;
    const bool is_unseen = to - from > longest && !is_seen;
    learned.at.push_back(x);
    const double value = is_unseen ? 0 : limit(curve.mean[b]);
    learned.value.push_back(value);
    learned.low.push_back(is_unseen ? 0 : std::min(limit(curve.low[b]), value));
    learned.high.push_back(is_unseen ? 0 : std::max(limit(curve.high[b]), value));
  }
  return learned;
}

std::optional<Learned> Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                             std::size_t channel, const Stream& stream) {
  if (block.learnable.empty()) return std::nullopt;
  return Learner(block, diagnosis, channel).Run(stream);
}

}  // namespace tera
