#include "diagnose/proposal/learn.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/statistics/regime/regime_axis.h"

namespace tera {
namespace {

constexpr double kLeastShare = -1, kMostShare = 9;
constexpr double kBandSigmas = 1.645;  ///< 5 to 95 % of a normal distribution
constexpr double kLongestGap = 0.25;   ///< of the range, over which a curve is believed
constexpr std::string_view kRate = "rate";

/// The factors of a term beside the rate itself, of which it is a share; none where it is no share.
std::optional<std::vector<Factor>> FactorsOfShare(const ProposedTerm& term) {
  std::vector<Factor> rest = term.factors;
  const auto rate = std::find(rest.begin(), rest.end(), Factor{std::string(kRate)});
  if (rate == rest.end()) return std::nullopt;
  rest.erase(rate);
  return rest;
}

/// The one variable of some factors; none where there are several or no factor.
std::optional<std::string> VariableOf(const std::vector<std::vector<Factor>>& terms) {
  std::optional<std::string> variable;
  for (const std::vector<Factor>& factors : terms) {
    for (const Factor& factor : factors) {
      if (variable && *variable != factor.variable) return std::nullopt;
      variable = factor.variable;
    }
  }
  return variable;
}

RegimeVariable SampledVariable(const Channel& channel, const std::vector<double>& predicted,
                               const std::string& name) {
  for (const RegimeVariable& variable : channel.variables) {
    if (variable.name == name) return variable;
  }
  return {name, {channel.measured.period_s, predicted, channel.measured.valid}};
}

double ProductAt(const std::vector<Factor>& factors, double x) {
  double product = 1;
  for (const Factor& factor : factors) product *= Shaped(factor.form, x);
  return product;
}

}  // namespace

std::optional<ProposedCurve> TabulatedFormula(const Channel& channel,
                                              const std::vector<double>& predicted,
                                              const std::vector<ProposedTerm>& terms) {
  std::vector<std::vector<Factor>> added, shares;
  for (const ProposedTerm& term : terms) {
    added.push_back(term.factors);
    if (auto rest = FactorsOfShare(term)) shares.push_back(std::move(*rest));
  }
  const bool is_share = shares.size() == terms.size() && VariableOf(shares).has_value();
  const std::vector<std::vector<Factor>>& factors = is_share ? shares : added;
  const std::optional<std::string> variable = VariableOf(factors);
  if (!variable) return std::nullopt;
  const RegimeAxis axis(SampledVariable(channel, predicted, *variable));
  if (axis.bins() < 2) return std::nullopt;
  ProposedCurve curve{*variable, is_share, axis.centre(), axis.centre(), {}, {}};
  curve.low = curve.high = curve.at;
  for (Eigen::Index b = 0; b < axis.bins(); ++b) {
    double mean = 0, variance = 0;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const double product = ProductAt(factors[t], curve.at[b]);
      mean += terms[t].coefficient * product;
      variance += std::pow(terms[t].sigma * product, 2);
    }
    curve.mean[b] = mean;
    curve.low[b] = mean - kBandSigmas * std::sqrt(variance);
    curve.high[b] = mean + kBandSigmas * std::sqrt(variance);
  }
  return curve;
}

LearnedEffect TabulatedCurve(const ProposedCurve& curve, const LearnedVariable& variable,
                             const std::vector<double>& seen) {
  LearnedEffect learned{variable, curve.is_share, {}, {}, {}, {}};
  std::vector<double> places = seen;
  std::sort(places.begin(), places.end());
  const double longest = kLongestGap * (curve.at[curve.at.size() - 1] - curve.at[0]);
  const auto limit = [&](double value) {
    return curve.is_share ? std::clamp(value, kLeastShare, kMostShare) : value;
  };
  for (Eigen::Index b = 0; b < curve.at.size(); ++b) {
    const double x = curve.at[b];
    const auto above = std::lower_bound(places.begin(), places.end(), x);
    const double from = above == places.begin() ? curve.at[0] : *(above - 1);
    const double to = above == places.end() ? curve.at[curve.at.size() - 1] : *above;
    const bool is_seen = above != places.end() && *above == x;
    const bool is_unseen = to - from > longest && !is_seen;
    learned.at.push_back(x);
    const double value = is_unseen ? 0 : limit(curve.mean[b]);
    learned.value.push_back(value);
    learned.low.push_back(is_unseen ? 0 : std::min(limit(curve.low[b]), value));
    learned.high.push_back(is_unseen ? 0 : std::max(limit(curve.high[b]), value));
  }
  return learned;
}

namespace {

/// RMSE on SELECT over that of an effect nearer to what is said, at most, for another to be
/// learned.
constexpr double kMostOtherRatio = 0.9;

using MayDepend = std::function<bool(const RegimeVariable&)>;

/// Measured less predicted, where the fit had both.
Series Difference(const Series& measured, const std::vector<double>& predicted, const Mask& valid) {
  Series difference = measured;
  difference.valid = valid;
  for (std::size_t k = 0; k < predicted.size(); ++k) difference.value[k] -= predicted[k];
  return difference;
}

class Learner {
 public:
  Learner(const ReplayBlock& block, const BlockDiagnosis& diagnosis, std::size_t channel)
      : block_(block),
        diagnosis_(diagnosis),
        channel_(channel),
        predicted_(block.predict(diagnosis.search.found.terms)[channel]),
        residual_(Difference(block.channels[channel].measured, predicted_,
                             diagnosis.search.found.misfit.residual[channel].valid)) {}

  std::optional<LearnedProposal> Learn(const Proposal& proposal, const Stream& stream) const;

 private:
  const LearnedVariable* Known(const std::string& name) const;
  std::vector<double> SeenOf(const std::string& variable) const;
  std::optional<LearnedEffect> OfFormula(const std::vector<ProposedTerm>& terms) const;
  std::optional<LearnedEffect> OfBestCurve(const MayDepend& may_depend, const Stream& stream) const;
  std::vector<LearnedEffect> Candidates(const Proposal& proposal, const Stream& stream) const;
  std::optional<LearnedEffect> OfCurve(const ProposedCurve& curve) const;
  Series Left(const LearnedEffect& effect) const;
  double RmsOn(Part part, const Series& left) const {
    return RmsOver(left, MaskOf(diagnosis_.manoeuvres, part, left.size()));
  }

  const ReplayBlock& block_;
  const BlockDiagnosis& diagnosis_;
  std::size_t channel_;
  const std::vector<double> predicted_;
  const Series residual_;
};

const LearnedVariable* Learner::Known(const std::string& name) const {
  const auto at = std::find_if(block_.learnable.begin(), block_.learnable.end(),
                               [&](const LearnedVariable& one) { return one.name == name; });
  return at != block_.learnable.end() ? &*at : nullptr;
}

/// The variable's values at the samples that the curve was fitted to.
std::vector<double> Learner::SeenOf(const std::string& variable) const {
  const std::vector<double>* values = &predicted_;
  for (const RegimeVariable& one : block_.channels[channel_].variables) {
    if (one.name == variable) values = &one.series.value;
  }
  std::vector<double> seen;
  for (const Segment& samples : SeenSegmentsOf(diagnosis_.manoeuvres)) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) {
      if (residual_.valid[k]) seen.push_back((*values)[k]);
    }
  }
  return seen;
}

std::optional<LearnedEffect> Learner::OfFormula(const std::vector<ProposedTerm>& terms) const {
  const auto curve = TabulatedFormula(block_.channels[channel_], predicted_, terms);
  return curve ? OfCurve(*curve) : std::nullopt;
}

std::optional<LearnedEffect> Learner::OfBestCurve(const MayDepend& may_depend,
                                                  const Stream& stream) const {
  const auto proposal = ProposeCurve({.channel = channel_,
                                      .manoeuvres = diagnosis_.manoeuvres,
                                      .variables = block_.channels[channel_].variables,
                                      .residual = residual_,
                                      .predicted = predicted_,
                                      .may_depend = may_depend},
                                     stream);
  return proposal ? OfCurve(*proposal->curve) : std::nullopt;
}

std::optional<LearnedEffect> Learner::OfCurve(const ProposedCurve& curve) const {
  const LearnedVariable* variable = Known(curve.variable);
  if (variable == nullptr) return std::nullopt;
  return TabulatedCurve(curve, *variable, SeenOf(curve.variable));
}

/// Residual of the replay with an effect.
Series Learner::Left(const LearnedEffect& effect) const {
  const std::vector<double> change =
      block_.change_by_learned(diagnosis_.search.found.terms, effect)[channel_];
  Series left = residual_;
  for (std::size_t k = 0; k < left.size(); ++k) left.value[k] -= change[k];
  return left;
}

/// The effects that may run, those nearest to what is said of the error first.
std::vector<LearnedEffect> Learner::Candidates(const Proposal& proposal,
                                               const Stream& stream) const {
  std::vector<std::optional<LearnedEffect>> all = {OfFormula(proposal.terms)};
  std::vector<std::string> names;
  for (const Unexplained& left : diagnosis_.unexplained) {
    if (left.location.channel != channel_ || left.location.regimes.empty()) continue;
    names.push_back(left.location.regimes.front().variable);
  }
  if (proposal.curve) names.push_back(proposal.curve->variable);
  for (const std::string& name : names) {
    if (Known(name) == nullptr) continue;
    all.push_back(OfBestCurve([&](const RegimeVariable& one) { return one.name == name; }, stream));
  }
  all.push_back(
      OfBestCurve([&](const RegimeVariable& one) { return Known(one.name) != nullptr; }, stream));
  std::vector<LearnedEffect> candidates;
  for (std::optional<LearnedEffect>& one : all) {
    if (one) candidates.push_back(std::move(*one));
  }
  return candidates;
}

std::optional<LearnedProposal> Learner::Learn(const Proposal& proposal,
                                              const Stream& stream) const {
  std::optional<LearnedEffect> best;
  double least = 0;
  for (LearnedEffect& one : Candidates(proposal, stream)) {
    const double rmse = RmsOn(Part::kSelect, Left(one));
    if (best && rmse >= kMostOtherRatio * least) continue;
    best = std::move(one);
    least = rmse;
  }
  if (!best) return std::nullopt;
  LearnedProposal learned{*best, RmsOn(Part::kFinal, residual_), RmsOn(Part::kFinal, Left(*best))};
  if (!Holds(learned.rmse_before, learned.rmse_after)) return std::nullopt;
  return learned;
}

}  // namespace

void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal) {
  if (block.learnable.empty()) {
    proposal->not_learned = "a simulation learns of joints, tracks and wheel sets alone, once each";
    return;
  }
  proposal->learned = Learner(block, diagnosis, proposal->channel).Learn(*proposal, stream);
  if (!proposal->learned) {
    proposal->not_learned =
        "no function of one variable that a simulation knows explains a twentieth of it";
  }
}

}  // namespace tera
