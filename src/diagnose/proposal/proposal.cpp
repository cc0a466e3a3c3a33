#include "diagnose/proposal/proposal.h"

#include <algorithm>
#include <cmath>

#include "diagnose/proposal/curve_proposal.h"
#include "diagnose/proposal/formula_proposal.h"

namespace tera {
namespace {

/// Share of FINAL's RMSE that a proposal must remove.
constexpr double kLeastGain = 0.05;
/// RMSE of a curve on SELECT over that of a formula, at most, for the curve to be proposed.
constexpr double kMostCurveRatio = 0.9;

}  // namespace

double RmsOver(const Series& series, const Mask& mask) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    if (!mask[k] || !series.valid[k]) continue;
    sum += series.value[k] * series.value[k];
    ++count;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

bool Holds(const Proposal& proposal) {
  return proposal.rmse_before > 0 && proposal.rmse_after <= (1 - kLeastGain) * proposal.rmse_before;
}

std::optional<Proposal> Propose(const ReplayBlock& block, const BlockDiagnosis& diagnosis,
                                std::size_t channel, const Stream& stream) {
  std::optional<Proposal> formula = ProposeFormula(block, diagnosis, channel, stream);
  std::optional<Proposal> curve = ProposeCurve(block, diagnosis, channel, stream);
  const bool takes_curve =
      curve && (!formula || curve->rmse_select < kMostCurveRatio * formula->rmse_select);
  return takes_curve ? std::move(curve) : std::move(formula);
}

}  // namespace tera
