#include "diagnose/statistics/partialling.h"

#include <optional>

#include "diagnose/statistics/multiple_testing.h"

namespace tera {
namespace {

std::vector<RegimeTestResult> TestAll(const RegimeDesign& design,
                                      const std::vector<RegimeProbe>& probes,
                                      const std::vector<bool>& taken,
                                      const RegimeTestOptions& options, const Stream& stream) {
  std::vector<RegimeTestResult> tests;
  for (std::size_t v = 0; v < probes.size(); ++v) {
    if (taken[v]) {
      tests.push_back({probes[v].name(), {}, 0});
    } else {
      tests.push_back(TestRegime(design, probes[v], options, stream));
    }
  }
  return tests;
}

/// The significant one of the largest share.
std::optional<PartiallingStep> Best(const std::vector<RegimeTestResult>& tests,
                                    const std::vector<bool>& taken, double alpha) {
  std::vector<std::size_t> open;
  std::vector<double> p;
  for (std::size_t v = 0; v < tests.size(); ++v) {
    if (taken[v]) continue;
    open.push_back(v);
    p.push_back(tests[v].comparison.p_tail);
  }
  const std::vector<double> adjusted = HolmAdjusted(p);
  std::optional<PartiallingStep> best;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const double share = tests[open[k]].share;
    if (adjusted[k] > alpha || (best && share <= best->share)) continue;
    best = PartiallingStep{open[k], adjusted[k], share, tests};
  }
  return best;
}

}  // namespace

Eigen::MatrixXd KnownColumns(const RegimeAxis& axis) {
  const Eigen::MatrixXd splines = axis.Splines(20);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(axis.samples()), splines.cols());
  for (Eigen::Index k = 0; k < columns.rows(); ++k) {
    columns.row(k) = splines.row(axis.bin()[static_cast<std::size_t>(k)]);
  }
  return columns;
}

Partialling SelectRegimes(const Series& residual, const NoiseModel& noise,
                          const std::vector<RegimeVariable>& variables,
                          const PartiallingOptions& options, const Stream& stream) {
  const WhiteningFilter filter(noise, residual.valid);
  std::vector<RegimeProbe> probes;
  for (const RegimeVariable& variable : variables) probes.emplace_back(variable, filter);
  std::vector<bool> taken(variables.size(), false);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  Partialling out;
  while (true) {
    const RegimeDesign design(residual, noise, known);
    std::vector<RegimeTestResult> tests = TestAll(design, probes, taken, options.test, stream);
    const std::optional<PartiallingStep> best = Best(tests, taken, options.alpha);
    if (!best || out.steps.size() == options.most) {
      out.left = std::move(tests);
      return out;
    }
    taken[best->variable] = true;
    const Eigen::MatrixXd columns = KnownColumns(probes[best->variable].axis());
    known.conservativeResize(Eigen::NoChange, known.cols() + columns.cols());
    known.rightCols(columns.cols()) = columns;
    out.steps.push_back(*best);
  }
}

}  // namespace tera
