#pragma once

#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Columns that show how far a thing turns beside its rates. All have as many numbers as there
/// are times; where they do not, they show nothing.
struct TurnWitness {
  std::vector<TimeNs> t_ns;
  /// The specific force along the axes of the rates, in any unit; empty: none.
  std::vector<const NumbersOfColumn*> forces = {};
  /// The angles that the rates are those of, in their order; null: none.
  std::vector<const NumbersOfColumn*> angles = {};
};

/// rad/s or deg/s: as a column's unit or name tells, by how far gravity or an angle turns beside
/// the rates, or by a size that no machine has in rad/s; else unknown, with what was seen.
///
/// Model   rates of which a tenth is beyond 20 are no rad/s, and beyond 1146 no deg/s either.
UnitGuess GuessRateUnit(const std::vector<const NumbersOfColumn*>& rates,
                        const TurnWitness& witness = {});

}  // namespace tera
