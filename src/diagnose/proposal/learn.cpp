#include "diagnose/proposal/learn.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/proposal/tabulated.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
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
