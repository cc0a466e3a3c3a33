#pragma once

#include <array>
#include <string>

#include "dataset/import/suggest/guess.h"

/// What the numbers of encoders and inertial units show beside their unit.

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

/// An inertial unit's columns. All have a number in every row, or nothing is said of them.
struct InertialColumns {
  const NumbersOfColumn* time = nullptr;  ///< null: rows of 10 ms
  UnitGuess time_unit;
  std::array<const NumbersOfColumn*, 3> rates, forces;
  UnitGuess rate_unit, force_unit;
};

/// Remarks on what is doubtful of a unit whose columns are imported in these units, a line each
/// that begins with `indent` and "# guessed:".
std::string InertialRemarks(const InertialColumns& columns, const std::string& indent);

}  // namespace tera
