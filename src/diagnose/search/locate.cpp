#include "diagnose/search/locate.h"

#include <algorithm>

#include "diagnose/statistics/change_points.h"
#include "diagnose/statistics/partialling.h"
#include "diagnose/statistics/whitening.h"

namespace tera {
namespace {

constexpr double kLeastShare = 0.02;
constexpr double kMuchMore = 1.3;  ///< times the criterion of what was significant

struct Told {
  std::size_t variable;
  double p, share;
};

/// Of all variables before any was taken in, the one that explains most, more than `least`.
Told MostTelling(const std::vector<RegimeTestResult>& tests, double least) {
  Told most{tests.size(), 1, 0};
  for (std::size_t v = 0; v < tests.size(); ++v) {
    if (tests[v].criterion <= kLeastShare || tests[v].whole_criterion <= least) continue;
    least = tests[v].whole_criterion;
    most = {v, tests[v].comparison.p, tests[v].share};
  }
  return most;
}

/// The variables that were taken in. Before them one that explains much more but moves too slowly
/// for a p that means anything, as time does; alone, if none was taken in.
std::vector<Told> Telling(const Partialling& found) {
  std::vector<Told> telling;
  double least = kLeastShare;
  if (!found.steps.empty()) {
    const PartiallingStep& first = found.steps.front();
    least = std::max(least, kMuchMore * first.tests[first.variable].criterion);
  }
  const auto& tests = found.steps.empty() ? found.left : found.steps.front().tests;
  const Told slow = MostTelling(tests, least);
  const bool is_first = !found.steps.empty() && slow.variable == found.steps.front().variable;
  if (slow.variable < tests.size() && !is_first) telling.push_back(slow);
  for (const PartiallingStep& step : found.steps) {
    if (step.variable == slow.variable && !is_first) continue;
    telling.push_back({step.variable, step.p_adjusted, step.share});
  }
  return telling;
}

/// The channel's variables, and each again as what a share of the simulated value may depend on.
std::vector<RegimeVariable> VariablesAndShares(const Channel& channel, const Series& residual) {
  std::vector<double> simulated(residual.size(), 0.0);
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (residual.valid[k]) simulated[k] = channel.measured.value[k] - residual.value[k];
  }
  std::vector<RegimeVariable> variables = channel.variables;
  for (const RegimeVariable& variable : channel.variables) {
    variables.push_back(variable);
    variables.back().times = simulated;
  }
  return variables;
}

/// What is known when a variable is asked: what came before, and what its curve is multiplied with.
Eigen::MatrixXd KnownBefore(const Eigen::MatrixXd& known, const RegimeAxis& axis) {
  return axis.has_times() ? WithColumns(known, axis.times()) : known;
}

}  // namespace

Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const Stream& stream, int threads) {
  Location location{index, {}, {}};
  location.intervals = FindChangePoints(Whiten(noise, residual).Steady(), noise.dof).mismatch;
  if (channel.variables.empty()) return location;
  const std::vector<RegimeVariable> variables = VariablesAndShares(channel, residual);
  const Partialling found = SelectRegimes(residual, noise, variables, {.threads = threads}, stream);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  for (const auto& [index_of_variable, p, share] : Telling(found)) {
    const RegimeVariable& variable = variables[index_of_variable];
    const RegimeAxis axis(variable);
    Regime regime{variable.name, axis.has_times(), p, share, {}, {}};
    regime.curve = FitRegimeCurve(residual, noise, KnownBefore(known, axis), variable, {}, stream);
    regime.shape = ClassifyCurve(regime.curve);
    location.regimes.push_back(std::move(regime));
    known = WithColumns(known, KnownColumns(axis));
  }
  return location;
}

}  // namespace tera
