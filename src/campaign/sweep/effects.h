#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tera {

/// A run's outcome and its values of the factors, as YAML.
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
  /// Bounds of the 95 % interval of the mean; without, where there is one run.
  std::optional<double> low, high;
};

/// Change of the outcome with a number.
struct Slope {
  double per_unit = 0, low = 0, high = 0;  ///< with the bounds of its 95 % interval
};

/// The effect of a factor, over all values of the others.
struct FactorEffect {
  std::string key;
  std::vector<LevelMean> levels;  ///< in the order of numbers, or of their first run
  bool is_numeric = false;        ///< all its values are numbers
  std::optional<Slope> slope;     ///< of numbers, from three runs on
};

/// Model   intervals are Student's, with the spread of the runs of a level; a slope is by least
///         squares, its interval from the residuals. Runs are independent.
/// Omits   interactions of factors.
/// Source  Montgomery, "Design and Analysis of Experiments", sections 2.4 and 10.4.
std::vector<FactorEffect> EffectsOf(const std::vector<std::string>& keys,
                                    const std::vector<SweptRun>& runs);

}  // namespace tera
