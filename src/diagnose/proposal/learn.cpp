#include "diagnose/proposal/learn.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/proposal/tabulated.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

class Learner {
 public:
  Learner(const ReplayBlock& block, const BlockDiagnosis& diagnosis, std::size_t channel)
      : block_(block),
        diagnosis_(diagnosis),
        channel_(channel),
        residual_(diagnosis.search.found.misfit.residual[channel]),
        predicted_(block.predict(diagnosis.search.found.terms)[channel]) {}

  std::optional<LearnedProposal> OfFormula(const std::vector<ProposedTerm>& terms) const {
    const auto curve = TabulatedFormula(block_.channels[channel_], predicted_, terms);
    return curve ? OfCurve(*curve) : std::nullopt;
  }
  std::optional<LearnedProposal> OfCurve(const ProposedCurve& curve) const;
  std::optional<LearnedProposal> OfBestCurve(const Stream& stream) const;

 private:
  const LearnedVariable* Known(const std::string& name) const;
  std::vector<double> SeenOf(const std::string& variable) const;

  const ReplayBlock& block_;
  const BlockDiagnosis& diagnosis_;
  std::size_t channel_;
  const Series& residual_;
  const std::vector<double> predicted_;
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

std::optional<LearnedProposal> Learner::OfCurve(const ProposedCurve& curve) const {
  const LearnedVariable* variable = Known(curve.variable);
  if (variable == nullptr) return std::nullopt;
  LearnedProposal learned{TabulatedCurve(curve, *variable, SeenOf(curve.variable))};
  const std::vector<double> change =
      block_.change_by_learned(diagnosis_.search.found.terms, learned.effect)[channel_];
  Series left = residual_;
  for (std::size_t k = 0; k < left.size(); ++k) left.value[k] -= change[k];
  const Mask final = MaskOf(diagnosis_.manoeuvres, Part::kFinal, left.size());
  learned.rmse_before = RmsOver(residual_, final);
  learned.rmse_after = RmsOver(left, final);
  if (!Holds(learned.rmse_before, learned.rmse_after)) return std::nullopt;
  return learned;
}

std::optional<LearnedProposal> Learner::OfBestCurve(const Stream& stream) const {
  const auto is_known = [&](const RegimeVariable& variable) {
    return Known(variable.name) != nullptr && !variable.angle;
  };
  const auto proposal = ProposeCurve(block_, diagnosis_, channel_, is_known, stream);
  return proposal ? OfCurve(*proposal->curve) : std::nullopt;
}

}  // namespace

void Learn(const ReplayBlock& block, const BlockDiagnosis& diagnosis, const Stream& stream,
           Proposal* proposal) {
  if (block.learnable.empty()) {
    proposal->not_learned = "a simulation learns of joints, tracks and wheel sets alone, once each";
    return;
  }
  const Learner learner(block, diagnosis, proposal->channel);
  proposal->learned =
      proposal->curve ? learner.OfCurve(*proposal->curve) : learner.OfFormula(proposal->terms);
  if (!proposal->learned) proposal->learned = learner.OfBestCurve(stream);
  if (!proposal->learned) {
    proposal->not_learned =
        "no function of one variable that a simulation knows explains a twentieth of it";
  }
}

}  // namespace tera
