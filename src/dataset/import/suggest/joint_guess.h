#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Joints that a table's columns tell of.
struct JointGuesses {
  /// The column of each one's angle, or of its rate where there is no angle, and its line.
  std::vector<std::pair<const NumbersOfColumn*, std::string>> joints;
  std::vector<const NumbersOfColumn*> columns;  ///< all that the lines name
};

/// Angles by JointOfAngle, each with its rate by JointOfRate where both have their numbers in the
/// same rows, and rates alone. `t_ns` are the times of the rows, none where they are not known.
JointGuesses GuessJoints(const std::vector<const NumbersOfColumn*>& columns,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
