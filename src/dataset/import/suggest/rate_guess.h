#pragma once

#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Columns that show rotation independently of the rates. A group counts only if all of its columns
/// have a number in every row.
struct TurnWitness {
  std::vector<TimeNs> t_ns;
  /// Specific force along the axes of the rates, in any unit; may be empty.
  std::vector<const NumbersOfColumn*> forces = {};
  /// Angles whose derivatives are the rates, in the same order; null where absent.
  std::vector<const NumbersOfColumn*> angles = {};
};

/// Guesses rad/s or deg/s; if unknown, the result states what was observed. Evidence is used in
/// this order: unit or name of a column; rates that are all zero (taken as rad/s); rotation of the
/// gravity vector; change of the angle; magnitude.
///
/// Model   By magnitude, rates are deg/s if a tenth of them exceeds 20. They are neither unit if a
///         tenth exceeds 1146. Magnitude is not used if the unit of the specific force is unknown
///         too, as in a table of raw counts.
UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates,
                        const TurnWitness& witness = {});

}  // namespace tera
