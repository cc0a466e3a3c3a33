#include "diagnose/search/locate.h"

#include "diagnose/statistics/change_points.h"
#include "diagnose/statistics/partialling.h"
#include "diagnose/statistics/whitening.h"

namespace tera {
namespace {

constexpr double kLeastShare = 0.02;

struct Told {
  std::size_t variable;
  double p, share;
};

/// The variables that were taken in; if none, for want of shifts, the one of the largest share.
std::vector<Told> Telling(const Partialling& found) {
  std::vector<Told> telling;
  for (const PartiallingStep& step : found.steps) {
    telling.push_back({step.variable, step.p_adjusted, step.share});
  }
  if (!telling.empty()) return telling;
  Told most{0, 1, kLeastShare};
  for (std::size_t v = 0; v < found.left.size(); ++v) {
    const RegimeTestResult& test = found.left[v];
    if (test.comparison.shifts == 0 || test.share < most.share) continue;
    most = {v, test.comparison.p, test.share};
  }
  if (most.share > kLeastShare) telling.push_back(most);
  return telling;
}

}  // namespace

Location Locate(const Channel& channel, std::size_t index, const Series& residual,
                const NoiseModel& noise, const Stream& stream) {
  Location location{index, {}, {}};
  location.intervals = FindChangePoints(Whiten(noise, residual).Steady(), noise.dof).mismatch;
  if (channel.variables.empty()) return location;
  const Partialling found = SelectRegimes(residual, noise, channel.variables, {}, stream);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  for (const auto& [index_of_variable, p, share] : Telling(found)) {
    const RegimeVariable& variable = channel.variables[index_of_variable];
    Regime regime{variable.name, p, share, {}, {}};
    regime.curve = FitRegimeCurve(residual, noise, known, variable, {}, stream);
    regime.shape = ClassifyCurve(regime.curve);
    location.regimes.push_back(std::move(regime));
    const Eigen::MatrixXd columns = KnownColumns(RegimeAxis(variable));
    known.conservativeResize(Eigen::NoChange, known.cols() + columns.cols());
    known.rightCols(columns.cols()) = columns;
  }
  return location;
}

}  // namespace tera
