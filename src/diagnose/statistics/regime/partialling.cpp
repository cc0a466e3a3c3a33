#include "diagnose/statistics/regime/partialling.h"

#include <optional>
#include <utility>

#include "core/in_parallel.h"
#include "diagnose/statistics/tests/multiple_testing.h"

namespace tera {
namespace {

/// Tests variables given known columns.
class Tester {
 public:
  Tester(const Series& residual, const NoiseModel& noise, const Eigen::MatrixXd& known,
         const std::vector<RegimeProbe>& probes)
      : plain_(residual, noise, known) {
    for (const RegimeProbe& probe : probes) {
      const RegimeAxis& axis = probe.axis();
      if (!axis.has_times() || WithTimes(axis) != nullptr) continue;
      with_times_.emplace_back(axis.times(),
                               RegimeDesign(residual, noise, WithColumns(known, axis.times())));
    }
  }

  RegimeTestResult Test(const RegimeProbe& probe, const RegimeTestOptions& options,
                        const Stream& stream) const {
    if (!probe.axis().has_times()) return TestRegime(plain_, probe, options, stream);
    const RegimeDesign& design = *WithTimes(probe.axis());
    RegimeTestResult test = TestRegime(design, probe, options, stream);
    const double energy = design.psi_variance() / plain_.psi_variance();
    test.share *= energy;
    test.criterion *= energy;
    test.whole_criterion = test.criterion + 1 - energy;
    return test;
  }

 private:
  /// The design that also knows the factor of an axis.
  const RegimeDesign* WithTimes(const RegimeAxis& axis) const {
    for (const auto& [times, design] : with_times_) {
      if (times == axis.times()) return &design;
    }
    return nullptr;
  }

  const RegimeDesign plain_;
  std::vector<std::pair<Eigen::VectorXd, RegimeDesign>> with_times_;
};

std::vector<RegimeTestResult> TestAll(const Tester& tester, const std::vector<RegimeProbe>& probes,
                                      const std::vector<bool>& selected,
                                      const PartiallingOptions& options, const Stream& stream) {
  return InParallel<RegimeTestResult>(probes.size(), options.threads, [&](std::size_t v) {
    if (selected[v]) return RegimeTestResult{probes[v].name(), {}, 0};
    return tester.Test(probes[v], options.test, stream);
  });
}

/// The significant variable with the best criterion.
std::optional<PartiallingStep> Best(const std::vector<RegimeTestResult>& tests,
                                    const std::vector<bool>& selected, double alpha) {
  std::vector<std::size_t> open;
  std::vector<double> p;
  for (std::size_t v = 0; v < tests.size(); ++v) {
    if (selected[v]) continue;
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
  if (columns.cols() > 0) out.rightCols(columns.cols()) = columns;
  return out;
}

Partialling SelectRegimes(const Series& residual, const NoiseModel& noise,
                          const std::vector<RegimeVariable>& variables,
                          const PartiallingOptions& options, const Stream& stream) {
  const WhiteningFilter filter(noise, residual.valid);
  std::vector<RegimeProbe> probes;
  for (const RegimeVariable& variable : variables) probes.emplace_back(variable, filter);
  std::vector<bool> selected(variables.size(), false);
  Eigen::MatrixXd known(static_cast<Eigen::Index>(residual.size()), 0);
  Partialling out;
  while (true) {
    std::vector<RegimeTestResult> tests =
        TestAll(Tester(residual, noise, known, probes), probes, selected, options, stream);
    const std::optional<PartiallingStep> best = Best(tests, selected, options.alpha);
    if (!best || out.steps.size() == options.most) {
      out.left = std::move(tests);
      return out;
    }
    selected[best->variable] = true;
    known = WithColumns(known, KnownColumns(probes[best->variable].axis()));
    out.steps.push_back(*best);
  }
}

}  // namespace tera
