#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

/// Findings in the numbers of encoders and inertial units, other than their unit.

namespace tera {

/// The unit of an angle, and whether its sensor wraps after a turn.
struct AngleGuess {
  UnitGuess unit;
  bool begins_anew = false;
};

/// The unit by GuessAngleUnit. The period of a wrapping angle without a unit in its name also gives
/// its unit: 2 pi, 360, 400 gon, tenths and hundredths of a degree, parts of a turn, counts of 8 to
/// 24 bits. `others` are joint angles of the same logger.
AngleGuess GuessAngle(const NumbersOfColumn& angle,
                      const std::vector<const NumbersOfColumn*>& others = {});

/// A rate and its unit.
struct RateColumn {
  std::string column;
  UnitGuess unit;
};

/// A joint of a mapping's encoders, as a line with its remark: with its angle, its rate, or both.
std::string JointYaml(const std::string& joint, const std::string& column, const AngleGuess& angle,
                      const std::optional<RateColumn>& rate = std::nullopt);
std::string JointYaml(const std::string& joint, const RateColumn& rate);

/// Remarks on a doubtful inertial unit, imported with these units of its three rates and three
/// accelerations: lines that begin with four blanks and "# guessed:". Rates have no remarks without
/// times or units. A column with a missing number gives no remarks at all.
std::string InertialRemarks(const std::vector<TimeNs>& t_ns,
                            const std::vector<const NumbersOfColumn*>& rates,
                            const UnitGuess& rate_unit,
                            const std::vector<const NumbersOfColumn*>& forces,
                            const UnitGuess& force_unit);

}  // namespace tera
