#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

/// Joints found in a table's columns.
struct JointGuesses {
  /// The column of each joint's angle, or of its rate without an angle, and its line.
  std::vector<std::pair<const NumbersOfColumn*, std::string>> joints;
  std::vector<const NumbersOfColumn*> columns;  ///< all columns in the lines
};

/// Angles by JointOfAngle, each with its rate by JointOfRate if both have numbers in the same rows,
/// and rates alone. `t_ns` are the times of the rows; empty if unknown.
JointGuesses GuessJoints(const std::vector<const NumbersOfColumn*>& columns,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
