#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

/// Guesses and warnings about the numbers of encoders and IMUs.

namespace tera {

/// Unit of an angle, and whether the angle wraps after a full turn.
struct AngleGuess {
  UnitGuess unit;
  bool begins_anew = false;
};

/// Guesses with GuessAngleUnit. If the name has no unit and the angle wraps, its period determines
/// the unit: 2 pi, 360, 400 gon, tenths or hundredths of a degree, fractions of a turn, or counts
/// of 8 to 24 bits. `others` are joint angles of the same logger.
AngleGuess GuessAngle(const NumbersOfColumn& angle,
                      const std::vector<const NumbersOfColumn*>& others = {});

struct RateColumn {
  std::string column;
  UnitGuess unit;
};

/// Line of a mapping for a joint that has an angle, a rate or both, with a remark on guesses.
std::string JointYaml(const std::string& joint, const std::string& column, const AngleGuess& angle,
                      const std::optional<RateColumn>& rate = std::nullopt);
std::string JointYaml(const std::string& joint, const RateColumn& rate);

/// Remarks on an IMU whose columns are doubtful under these units. Each line begins with four
/// blanks and "# guessed:". `rates` and `forces` have three columns each. Rates are not examined
/// without times or units. If any column lacks a number, the result is empty.
std::string InertialRemarks(const std::vector<TimeNs>& t_ns,
                            const std::vector<const NumbersOfColumn*>& rates,
                            const UnitGuess& rate_unit,
                            const std::vector<const NumbersOfColumn*>& forces,
                            const UnitGuess& force_unit);

}  // namespace tera
