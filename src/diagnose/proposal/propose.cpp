#include "diagnose/proposal/propose.h"

#include <utility>

#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/proposal/formula_proposal.h"
#include "diagnose/proposal/learn.h"

namespace tera {
namespace {

/// RMSE of a curve on SELECT over that of a formula, at most, for the curve to be proposed.
constexpr double kMostCurveRatio = 0.9;

}  // namespace

std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream) {
  std::optional<Proposal> formula = ProposeFormula(block, diagnosis, channel, stream);
  std::optional<Proposal> curve =
      ProposeCurve({.channel = channel,
                    .manoeuvres = diagnosis.manoeuvres,
                    .variables = block.channels[channel].variables,
                    .residual = diagnosis.search.found.misfit.residual[channel],
                    .predicted = block.predict(diagnosis.search.found.terms)[channel]},
                   stream);
  const bool takes_curve =
      curve && (!formula || curve->rmse_select < kMostCurveRatio * formula->rmse_select);
  std::optional<Proposal> proposal = takes_curve ? std::move(curve) : std::move(formula);
  if (proposal) Learn(block, diagnosis, stream, &*proposal);
  return proposal;
}

}  // namespace tera
