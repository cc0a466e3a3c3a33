#include "diagnose/proposal/tabulated.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace tera
