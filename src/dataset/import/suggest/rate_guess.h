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

/// rad/s or deg/s, or unknown with the observation. The first evidence that decides counts, in this
/// order: a column's unit or name; rates that are all zero, taken as rad/s; the turn of gravity;
/// the turn of an angle; magnitudes.
///
/// Model   magnitudes: rates with a tenth above 20 are deg/s, unless the unit of the specific force
///         is unknown too, as in a table of counts. With a tenth above 1146 they are neither.
UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates,
                        const TurnWitness& witness = {});

}  // namespace tera
