#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

/// Findings in the numbers of encoders and inertial units beside their unit.

namespace tera {

/// The unit of an angle, and whether its sensor begins anew after a turn of it.
struct AngleGuess {
  UnitGuess unit;
  bool begins_anew = false;
};

/// By GuessAngleUnit; where an angle without a unit in its name begins anew after a turn of some
/// size, that tells its unit: 2 pi, 360, 400 gon, tenths and hundredths of a degree, parts of a
/// turn, counts of 8 to 24 bits. `others` are angles of joints that the same logger wrote.
AngleGuess GuessAngle(const NumbersOfColumn& angle,
                      const std::vector<const NumbersOfColumn*>& others = {});

/// A rate and its unit.
struct RateColumn {
  std::string column;
  UnitGuess unit;
};

/// A joint of a mapping's encoders, a line with its remark: with its angle, its rate, or both.
std::string JointYaml(const std::string& joint, const std::string& column, const AngleGuess& angle,
                      const std::optional<RateColumn>& rate = std::nullopt);
std::string JointYaml(const std::string& joint, const RateColumn& rate);

/// Remarks on what is doubtful of an inertial unit whose three rates and three accelerations are
/// imported in these units: lines that begin with four blanks and "# guessed:". Rates have none
/// where there is no time or no unit. There are none at all where a column lacks a number.
std::string InertialRemarks(const std::vector<TimeNs>& t_ns,
                            const std::vector<const NumbersOfColumn*>& rates,
                            const UnitGuess& rate_unit,
                            const std::vector<const NumbersOfColumn*>& forces,
                            const UnitGuess& force_unit);

}  // namespace tera
