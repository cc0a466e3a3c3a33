#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "dataset/import/column_mapping.h"

namespace tera {

/// Numbers of a column, for guesses.
struct NumbersOfColumn {
  std::string name;
  std::vector<double> values;  ///< values in fields with a number
  std::string unit;            ///< as written in the table next to the name; empty: none
  std::size_t missing = 0;     ///< empty fields
  std::size_t words = 0;       ///< non-empty fields without a number
  std::size_t gaps = 0;        ///< digest of the rows without a number; 0: none
  double LargestSize() const;
  double Least() const;
  double MedianStep() const;
};

/// Placeholder unit, which the import refuses.
inline constexpr const char* kUnknownUnit = "unknown";

/// A unit of the mapping, with the reason if it is uncertain.
struct UnitGuess {
  std::string unit;
  double scale = 1.0;
  std::string doubt;  ///< empty: certain; for a placeholder unit, the observation

  bool is_known() const { return unit != kUnknownUnit; }
};

/// The unit of a column of any dimension, from its line of units, the brackets or the ending of its
/// name. Otherwise '1', with the known facts as the doubt.
UnitGuess GuessAnyUnit(const NumbersOfColumn& column);
/// The unit from a column's line of units or its name; nothing without either.
std::optional<UnitGuess> ToldUnit(const NumbersOfColumn& column, Dimension dimension);
/// m/s2 or g, from the length of the median vector, which is gravity for a machine; else unknown.
UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes);
/// rad or deg of the joint angles of one logger: deg if one exceeds a turn in rad. A single joint
/// below that is unknown.
UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles);
/// Whether a name means raw counts of a sensor: raw, counts, adc, ticks.
bool NamesCounts(std::string_view name);

/// Larger times in s count from an epoch.
inline constexpr double kLeastEpoch_s = 1e8;

/// The `origin:` of a mapping with the rows' own height, above the ellipsoid or the sea. `which`
/// names the row.
std::string OriginYaml(double lat_deg, double lon_deg, double height_m, std::string_view which);

/// The `valid_if:` of a channel, with its reasons.
class RuleGuesses {
 public:
  void Add(const std::string& rule, const std::string& reason);
  /// "valid_if: [...]   # guessed: ..." with `indent`, or nothing without a rule.
  std::string Yaml(std::string_view indent = "    ") const;

 private:
  std::string rules_, reasons_;
};

/// Steps between the times of consecutive rows.
struct TimeSteps {
  std::int64_t rows = 0, repeated = 0, back = 0;

  void Add(TimeNs t_ns);
  /// Whether the times are useless: all equal, or at least half of them repeat the previous one.
  bool IsStuck() const { return rows > 1 && 2 * repeated >= rows - 1; }

 private:
  TimeNs last_ns_ = 0;
};
/// Leaves out rows that repeat a time.
void AddStepRule(const TimeSteps& steps, const std::string& column, RuleGuesses* rules);

/// Unique names of channels.
class TakenNames {
 public:
  std::string Take(std::string_view wanted);

 private:
  std::set<std::string> names_;
};

/// "{column: gx, unit: deg/s}"
std::string ColumnYaml(std::string_view column, const UnitGuess& unit);
/// A trailing remark for a doubt, else nothing.
std::string DoubtRemark(const UnitGuess& unit);
/// A YAML scalar, quoted if necessary.
std::string YamlWord(std::string_view text);
/// Lower-case words of a name, split at non-letters and before capitals: {"boom", "speed", "cmd"}
/// for "boomSpeed_cmd2". Text in brackets is left out.
std::vector<std::string> WordsOfName(std::string_view name);
/// A name without case, unit, and characters other than letters and digits: "gyrox" for "Gyro X
/// [deg/s]".
std::string StemOfName(std::string_view name);
/// The joint that a word means in English, German or French; empty: none.
std::string JointOfWord(std::string_view word);
/// The joint whose angle a column holds, by its name and unit; empty: none.
std::string JointOfAngle(const NumbersOfColumn& column);
/// The joint whose rate a column holds (boom_rate, arm_velocity [deg/s]); empty: none.
std::string JointOfRate(const NumbersOfColumn& column);
/// A name for a channel or a column: letters, digits and '_'.
std::string PlainNameOf(std::string_view text);

}  // namespace tera
