#include "diagnose/statistics/partialling.h"

#include <optional>

#include "diagnose/statistics/multiple_testing.h"

namespace tera {
namespace {

/// Asks variables for what they say beyond what is known.
class Tester {
 public:
  Tester(const Series& residual, const NoiseModel& noise, const Eigen::MatrixXd& known)
      : residual_(residual), noise_(noise), known_(known), plain_(residual, noise, known) {}

  RegimeTestResult Test(const RegimeProbe& probe, const RegimeTestOptions& options,
                        const Stream& stream) {
    if (!probe.axis().has_times()) return TestRegime(plain_, probe, options, stream);
    const Eigen::VectorXd& times = probe.axis().times();
    if (!with_times_ || times_ != times) {
      times_ = times;
      with_times_.emplace(residual_, noise_, WithColumns(known_, times));
    }
    RegimeTestResult test = TestRegime(*with_times_, probe, options, stream);
    const double energy = with_times_->psi_variance() / plain_.psi_variance();
    test.share *= energy;
    test.criterion *= energy;
    test.whole_criterion = test.criterion + 1 - energy;
    return test;
  }

 private:
  const Series& residual_;
  const NoiseModel& noise_;
  const Eigen::MatrixXd& known_;
  const RegimeDesign plain_;
  Eigen::VectorXd times_;
  std::optional<RegimeDesign> with_times_;  ///< knows `times_` too
};

std::vector<RegimeTestResult> TestAll(Tester tester, const std::vector<RegimeProbe>& probes,
                                      const std::vector<bool>& taken,
                                      const RegimeTestOptions& options, const Stream& stream) {
  std::vector<RegimeTestResult> tests;
  for (std::size_t v = 0; v < probes.size(); ++v) {
    if (taken[v]) {
      tests.push_back({probes[v].name(), {}, 0});
    } else {
      tests.push_back(tester.Test(probes[v], options, stream));
    }
  }
  return tests;
}

/// The significant one of the best criterion.
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
    const RegimeTestResult& test = tests[open[k]];
    if (adjusted[k] > alpha || (best && test.criterion <= tests[best->variable].criterion))
      continue;
    best = PartiallingStep{open[k], adjusted[k], test.share, {}};
  }
  if (best) best->tests = tests;
  return best;
}

}  // namespace

Eigen::MatrixXd KnownColumns(const RegimeAxis& axis) {
  const Eigen::MatrixXd splines = axis.Splines(20);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(axis.samples()), splines.cols());
  for (Eigen::Index k = 0; k < columns.rows(); ++k) {
    columns.row(k) = axis.times()[k] * splines.row(axis.bin()[static_cast<std::size_t>(k)]);
  }
  return columns;
}

Eigen::MatrixXd WithColumns(const Eigen::MatrixXd& known, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd out(columns.rows(), known.cols() + columns.cols());
  if (known.cols() > 0) out.leftCols(known.cols()) = known;
  out.rightCols(columns.cols()) = columns;
  return out;
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
    std::vector<RegimeTestResult> tests =
        TestAll(Tester(residual, noise, known), probes, taken, options.test, stream);
    const std::optional<PartiallingStep> best = Best(tests, taken, options.alpha);
    if (!best || out.steps.size() == options.most) {
      out.left = std::move(tests);
      return out;
    }
    taken[best->variable] = true;
    known = WithColumns(known, KnownColumns(probes[best->variable].axis()));
    out.steps.push_back(*best);
  }
}

}  // namespace tera
