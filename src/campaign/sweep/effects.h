#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tera {

/// Outcome of a run, and its factor values in YAML.
struct SweptRun {
  int number = 0;
  std::vector<std::string> values;
  double outcome = 0;
};

/// Mean outcome of the runs with one value of a factor.
struct LevelMean {
  std::string level;
  int runs = 0;
  double mean = 0;
  /// 95 % confidence interval of the mean; absent if there is only one run.
  std::optional<double> low, high;
};

/// Change of the outcome per unit of a numeric factor.
struct Slope {
  double per_unit = 0, low = 0, high = 0;  ///< low and high: 95 % confidence interval
};

/// Effect of a factor, averaged over the values of the other factors.
struct FactorEffect {
  std::string key;
  std::vector<LevelMean> levels;  ///< sorted by value if numeric, otherwise in order of first
                                  ///< occurrence
  bool is_numeric = false;        ///< all levels are numbers
  std::optional<Slope> slope;     ///< for a numeric factor with at least three runs
};

/// Model   Intervals use Student's t distribution and the standard deviation within a level. The
///         slope is a least-squares fit; its interval uses the residuals. Runs are assumed
///         independent.
/// Omits   interactions of factors.
/// Source  Montgomery, "Design and Analysis of Experiments", sections 2.4 and 10.4.
std::vector<FactorEffect> EffectsOf(const std::vector<std::string>& keys,
                                    const std::vector<SweptRun>& runs);

}  // namespace tera
