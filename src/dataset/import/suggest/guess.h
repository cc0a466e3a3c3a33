#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// Numbers of a column, for guesses.
struct NumbersOfColumn {
  std::string name;
  std::vector<double> values;  ///< where there is a number
  bool increases = false;      ///< from each to the next
  double LargestSize() const;
  double MedianStep() const;
};

/// A unit of the mapping's, and where it is not sure why it is thought so.
struct UnitGuess {
  std::string unit;
  double scale = 1.0;
  std::string doubt;  ///< empty: sure
};

/// By magnitude where times are of an epoch, else by the name's ending, else by the step.
UnitGuess GuessTimeUnit(const NumbersOfColumn& time);
/// rad/s or deg/s: by the names' ending, else no machine turns at 20 rad/s.
UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates);
/// m/s2 or g: by the length of the median vector, which is gravity of a machine.
UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes);
/// rad or deg of an angle or a geodetic coordinate.
UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles);

/// Epochs: times in s beyond count from 1970.
inline constexpr double kLeastEpoch_s = 1e8;
double SecondsOf(const UnitGuess& unit);

/// "{column: gx, unit: deg/s}"
std::string ColumnYaml(std::string_view column, const UnitGuess& unit);
/// A remark behind a line where there is a doubt, else nothing.
std::string DoubtRemark(const UnitGuess& unit);
/// Words as YAML takes them, in quotes where they need them.
std::string YamlWord(std::string_view text);
/// A name for a channel or a column: letters, digits and '_'.
std::string PlainNameOf(std::string_view text);

}  // namespace tera
