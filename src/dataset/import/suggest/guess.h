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

/// Content of a column, as the guesses need it.
struct NumbersOfColumn {
  std::string name;
  std::vector<double> values;  ///< values of the fields that hold a number
  std::string unit;            ///< unit written next to the name; empty if none
  std::size_t missing = 0;     ///< number of empty fields
  std::size_t words = 0;       ///< number of non-empty fields that are not numbers
  std::size_t gaps = 0;        ///< hash of the set of rows without a number; 0 if there are none
  double LargestSize() const;
  double Least() const;
  double MedianStep() const;
};

/// Placeholder unit that the import refuses.
inline constexpr const char* kUnknownUnit = "unknown";

/// A guessed unit, with the reason if it is uncertain.
struct UnitGuess {
  std::string unit;
  double scale = 1.0;
  std::string doubt;  ///< empty if certain; for the placeholder unit, what was observed

  bool is_known() const { return unit != kUnknownUnit; }
};

/// Unit of any dimension, from the line of units, from brackets, or from the ending of the name.
/// Otherwise '1', with a remark on what is known.
UnitGuess GuessAnyUnit(const NumbersOfColumn& column);
/// Unit from the line of units or the name; nullopt if neither gives one.
std::optional<UnitGuess> ToldUnit(const NumbersOfColumn& column, Dimension dimension);
/// m/s2 or g, by the length of the median vector, which is gravity on a machine; otherwise unknown.
UnitGuess GuessAccelerationUnit(const std::vector<const NumbersOfColumn*>& axes);
/// rad or deg for the joint angles of one logger. An angle above one turn in rad means deg. A
/// single joint below that is unknown.
UnitGuess GuessAngleUnit(const std::vector<const NumbersOfColumn*>& angles);
/// True if a name suggests raw counts of a sensor: raw, counts, adc, ticks.
bool NamesCounts(std::string_view name);

/// Times above this number of seconds count from an epoch.
inline constexpr double kLeastEpoch_s = 1e8;

/// The key `origin` of a mapping. The height is that of the row, above the ellipsoid or the sea.
/// `which` describes the row in a remark.
std::string OriginYaml(double lat_deg, double lon_deg, double height_m, std::string_view which);

/// Collects the items of a channel's `valid_if`, with reasons.
class RuleGuesses {
 public:
  void Add(const std::string& rule, const std::string& reason);
  /// Line "valid_if: [...]   # guessed: ..." with `indent`; empty without rules.
  std::string Yaml(std::string_view indent = "    ") const;

 private:
  std::string rules_, reasons_;
};

/// Counts irregular steps between the times of consecutive rows.
struct TimeSteps {
  std::int64_t rows = 0, repeated = 0, back = 0;

  void Add(TimeNs t_ns);
  /// True if the times are useless: at least half of them repeat the previous one.
  bool IsStuck() const { return rows > 1 && 2 * repeated >= rows - 1; }

 private:
  TimeNs last_ns_ = 0;
};
/// Adds a rule that excludes rows which repeat a time.
void AddStepRule(const TimeSteps& steps, const std::string& column, RuleGuesses* rules);

/// Gives channels unique names.
class TakenNames {
 public:
  std::string Take(std::string_view wanted);

 private:
  std::set<std::string> names_;
};

/// Text such as "{column: gx, unit: deg/s}".
std::string ColumnYaml(std::string_view column, const UnitGuess& unit);
/// Remark on an uncertain unit, for the end of a line; empty if certain.
std::string DoubtRemark(const UnitGuess& unit);
std::string YamlWord(std::string_view text);
/// Words of a name in lower case, split at non-letters and before capitals: {"boom", "speed",
/// "cmd"} for "boomSpeed_cmd2". Text in brackets is ignored.
std::vector<std::string> WordsOfName(std::string_view name);
/// A name in lower case, without unit, with only letters and digits: "gyrox" for "Gyro X [deg/s]".
std::string StemOfName(std::string_view name);
/// The joint that an English, German or French word denotes; empty if none.
std::string JointOfWord(std::string_view word);
/// The joint whose angle the column holds, by name and unit; empty if none.
std::string JointOfAngle(const NumbersOfColumn& column);
/// The joint whose rate the column holds, such as boom_rate or arm_velocity [deg/s]; empty if none.
std::string JointOfRate(const NumbersOfColumn& column);
/// A valid name for a channel or column: letters, digits and '_'.
std::string PlainNameOf(std::string_view text);

}  // namespace tera
