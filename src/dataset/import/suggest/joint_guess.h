#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/time.h"
#include "dataset/import/suggest/guess.h"

namespace tera {

struct JointGuesses {
  /// The column of each joint's angle, or else of its rate, with the joint's line for the mapping.
  std::vector<std::pair<const NumbersOfColumn*, std::string>> joints;
  std::vector<const NumbersOfColumn*> columns;  ///< every column that these lines mention
};

/// Finds angles with JointOfAngle and rates with JointOfRate. An angle and a rate of a joint are
/// combined if they have numbers in the same rows. A rate may be alone. `t_ns` are the row times;
/// empty if unknown.
JointGuesses GuessJoints(const std::vector<const NumbersOfColumn*>& columns,
                         const std::vector<TimeNs>& t_ns);

}  // namespace tera
