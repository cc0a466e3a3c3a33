#pragma once

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
/// turn, counts of 8 to 24 bits.
AngleGuess GuessAngle(const NumbersOfColumn& angle);

/// A joint of a mapping's encoders with its angle, a line with its remark.
std::string JointYaml(const std::string& joint, const NumbersOfColumn& angle);

/// Remarks on what is doubtful of an inertial unit whose three rates and three accelerations are
/// imported in the units that are guessed of them: lines that begin with four blanks and "#
/// guessed:". Rates have none where there is no time. There are none at all where a column lacks a
/// number.
std::string InertialRemarks(const std::vector<TimeNs>& t_ns,
                            const std::vector<const NumbersOfColumn*>& rates,
                            const std::vector<const NumbersOfColumn*>& forces);

}  // namespace tera
