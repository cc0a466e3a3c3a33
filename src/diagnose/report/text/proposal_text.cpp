#include "diagnose/report/text/proposal_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "diagnose/report/text/words.h"

namespace tera {
namespace {

std::string FactorText(const ReplayBlock& block, const Factor& factor) {
  const std::string name =
      factor.variable == "rate" ? "rate" : VariableText(factor.variable, block);
  switch (factor.form) {
    case FactorForm::kValue:
      return name;
    case FactorForm::kMagnitude:
      return "|" + name + "|";
    case FactorForm::kSign:
      return "sign(" + name + ")";
    case FactorForm::kSquare:
      return name + "²";
    case FactorForm::kSignedSquare:
      return name + "·|" + name + "|";
    case FactorForm::kSine:
      return "sin(" + name + ")";
    case FactorForm::kCosine:
      return "cos(" + name + ")";
  }
  return name;
}

/// The power of its variable's unit that a factor has.
int PowerOf(FactorForm form) {
  switch (form) {
    case FactorForm::kValue:
    case FactorForm::kMagnitude:
      return 1;
    case FactorForm::kSquare:
    case FactorForm::kSignedSquare:
      return 2;
    case FactorForm::kSign:
    case FactorForm::kSine:
    case FactorForm::kCosine:
      return 0;
  }
  return 0;
}

std::string NumberText(const ReplayBlock& block, const Proposal& proposal,
                       const ProposedTerm& term) {
  const std::string unit = CoefficientUnit(block, proposal.channel, term.factors);
  const std::string number = WithSigma(term.coefficient, term.sigma);
  return unit == "1" ? number : fmt::format("({}) {}", number, unit);
}

}  // namespace

std::string TermText(const ReplayBlock& block, const std::vector<Factor>& factors) {
  std::string text;
  for (const Factor& factor : factors) {
    text += (text.empty() ? "" : " · ") + FactorText(block, factor);
  }
  return text;
}

std::string CoefficientUnit(const ReplayBlock& block, std::size_t channel,
                            const std::vector<Factor>& factors) {
  const std::string& own = block.channels[channel].unit;
  std::string above = own;
  std::map<std::string, int> below;
  for (const Factor& factor : factors) {
    const int power = PowerOf(factor.form);
    const std::string unit = factor.variable == "rate" ? own : UnitOfVariable(factor.variable, own);
    if (power == 0 || unit == "1") continue;
    if (unit == own && above == own && power == 1) {
      above.assign(1, '1');
    } else {
      below[unit] += power;
    }
  }
  for (const auto& [unit, power] : below) {
    above += power == 1 ? fmt::format("/({})", unit) : fmt::format("/({})^{}", unit, power);
  }
  return above;
}

std::string FormulaText(const ReplayBlock& block, const Proposal& proposal) {
  if (proposal.curve) {
    return fmt::format("{}c({})", proposal.curve->is_share ? "rate · " : "",
                       VariableText(proposal.curve->variable, block));
  }
  std::string text;
  for (const ProposedTerm& term : proposal.terms) {
    text += fmt::format("{}{} · {}", text.empty() ? "" : " + ", NumberText(block, proposal, term),
                        TermText(block, term.factors));
  }
  return text;
}

namespace {

/// The range of a curve as text.
std::string CurveText(const ReplayBlock& block, const Proposal& proposal) {
  const ProposedCurve& curve = *proposal.curve;
  const std::string& own = block.channels[proposal.channel].unit;
  const ReadableUnit unit = curve.is_share ? ReadableUnit{1, ""} : ReadableUnitOf(own);
  const ReadableUnit at = ReadableUnitOf(UnitOfVariable(curve.variable, own));
  Eigen::Index least = 0, most = 0;
  curve.mean.minCoeff(&least);
  curve.mean.maxCoeff(&most);
  const auto place = [&](Eigen::Index bin) {
    return fmt::format("{} at {}", Readable(curve.mean[bin], unit), Readable(curve.at[bin], at));
  };
  return fmt::format("a curve for what is left, a proposal and no name: add {}, c from {} to {}",
                     FormulaText(block, proposal), place(least), place(most));
}

std::string TermsText(const ReplayBlock& block, const Proposal& proposal) {
  double stability = 1;
  for (const ProposedTerm& term : proposal.terms) stability = std::min(stability, term.stability);
  return fmt::format(
      "a formula for what is left, a proposal and no name: add {} (SI units; chosen in {} of "
      "random halves of the manoeuvres)",
      FormulaText(block, proposal), PercentText(stability));
}

}  // namespace

const Proposal* ProposalFor(const DiagnosedBlock& diagnosed, std::size_t channel) {
  for (const Proposal& proposal : diagnosed.proposals) {
    if (proposal.channel == channel) return &proposal;
  }
  return nullptr;
}

std::string LearnedText(const ReplayBlock& block, const Proposal& proposal) {
  if (!proposal.learned) {
    return fmt::format("It is not in effects.yaml: {}.", proposal.not_learned);
  }
  const LearnedProposal& learned = *proposal.learned;
  return fmt::format(
      "As a function of {} it is in effects.yaml as learned: held-out RMSE {} in the replay.",
      VariableText(learned.effect.variable.name, block),
      Change(learned.rmse_before, learned.rmse_after, block.channels[proposal.channel].unit));
}

std::string SentenceOf(const ReplayBlock& block, const Proposal& proposal) {
  const Channel& channel = block.channels[proposal.channel];
  return fmt::format("{}: {}. Held-out RMSE {}. {}", Capitalised(QuantityOf(channel.name)),
                     proposal.curve ? CurveText(block, proposal) : TermsText(block, proposal),
                     Change(proposal.rmse_before, proposal.rmse_after, channel.unit),
                     LearnedText(block, proposal));
}

}  // namespace tera
