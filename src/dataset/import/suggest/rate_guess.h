#pragma once

#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Columns that show the turn besides the rates. They count only if all have a number at each time.
struct TurnWitness {
  std::vector<TimeNs> t_ns;
  /// The specific force along the axes of the rates, in any unit; empty: none.
  std::vector<const NumbersOfColumn*> forces = {};
  /// The angles of the rates, in their order; null: none.
  std::vector<const NumbersOfColumn*> angles = {};
};

/// rad/s or deg/s, from the first of: a column's unit or name; the turn of gravity or of an angle;
/// magnitudes that no machine has in rad/s. Otherwise unknown, with the observation.
///
/// Model   rates with a tenth above 20 are not rad/s, and above 1146 not deg/s either.
UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates,
                        const TurnWitness& witness = {});

}  // namespace tera
