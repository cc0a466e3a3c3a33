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
  std::vector<double> values;  ///< where there is a number
  std::string unit;            ///< as the table writes it beside the name; empty: it does not
  std::size_t missing = 0;     ///< fields that hold nothing
  std::size_t words = 0;       ///< fields that hold something else than a number
  std::size_t gaps = 0;        ///< a digest of which rows have no number; 0: all have one
  double LargestSize() const;
  double Least() const;
  double MedianStep() const;
};

/// The unit that is left to be filled in, which the import refuses.
inline constexpr const char* kUnknownUnit = "unknown";

/// A unit of the mapping's, and where it is not sure why it is thought so.
struct UnitGuess {
  std::string unit;
  double scale = 1.0;
  std::string doubt;  ///< empty: sure; of a unit to be filled in, what was seen

  bool is_known() const { return unit != kUnknownUnit; }
};

/// The unit of a column that may be of any dimension, by its line of units, the brackets or the
/// ending of its name; '1' where none tells, with what is known of it as the doubt.
UnitGuess GuessAnyUnit(const NumbersOfColumn& column);
/// The unit that a column's line of units or its name tells; none where neither does.
std::optional<UnitGuess> ToldUnit(const NumbersOfColumn& column, Dimension dimension);
/// m/s2 or g: by the length of the median vector, which is gravity of a machine; else unknown.
UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes);
/// rad or deg of angles of joints that one logger wrote: deg where one is beyond a turn in rad; of
/// one joint alone unknown where it is not.
UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles);
/// Whether a name says that its numbers are counts of a sensor: raw, counts, adc, ticks.
bool NamesCounts(std::string_view name);

/// Times in s beyond count from an epoch.
inline constexpr double kLeastEpoch_s = 1e8;

/// The `origin:` of a mapping, whose height is that of the rows: above the ellipsoid or above the
/// sea as they are. `which` says of which row it is.
std::string OriginYaml(double lat_deg, double lon_deg, double height_m, std::string_view which);

/// The `valid_if:` of a channel, with the reasons behind it.
class RuleGuesses {
 public:
  void Add(const std::string& rule, const std::string& reason);
  /// "valid_if: [...]   # guessed: ..." behind `indent`, or nothing where there is no rule.
  std::string Yaml(std::string_view indent = "    ") const;

 private:
  std::string rules_, reasons_;
};

/// How the times of rows follow each other.
struct TimeSteps {
  std::int64_t rows = 0, repeated = 0, back = 0;

  void Add(TimeNs t_ns);
  /// Whether they are of no use: all the same, or at least half of them repeat the one before.
  bool IsStuck() const { return rows > 1 && 2 * repeated >= rows - 1; }

 private:
  TimeNs last_ns_ = 0;
};
/// Leaves rows out that repeat a time.
void AddStepRule(const TimeSteps& steps, const std::string& column, RuleGuesses* rules);

/// Names of channels, each given once.
class TakenNames {
 public:
  std::string Take(std::string_view wanted);

 private:
  std::set<std::string> names_;
};

/// "{column: gx, unit: deg/s}"
std::string ColumnYaml(std::string_view column, const UnitGuess& unit);
/// A remark behind a line where there is a doubt, else nothing.
std::string DoubtRemark(const UnitGuess& unit);
/// Words as YAML takes them, in quotes where they need them.
std::string YamlWord(std::string_view text);
/// Words of a name in lower case, parted at what is no letter and where capitals begin: {"boom",
/// "speed", "cmd"} of "boomSpeed_cmd2". Text in brackets is left out.
std::vector<std::string> WordsOfName(std::string_view name);
/// A name without case, unit and what is neither letter nor digit: "gyrox" of "Gyro X [deg/s]".
std::string StemOfName(std::string_view name);
/// The joint of a machine that a word means in English, German or French; empty: none.
std::string JointOfWord(std::string_view word);
/// The joint whose angle a column is by its name and its unit; empty: of none.
std::string JointOfAngle(const NumbersOfColumn& column);
/// The joint whose rate a column is (boom_rate, arm_velocity [deg/s]); empty: of none.
std::string JointOfRate(const NumbersOfColumn& column);
/// A name for a channel or a column: letters, digits and '_'.
std::string PlainNameOf(std::string_view text);

}  // namespace tera
