#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Angle sensors that wrap after a turn: 360 to 0, 180 to -180.

/// Rows at which an angle jumps, from the second on. A jump exceeds half a turn of `turn`, in the
/// angle's own unit. It differs by as much from the steps before and after it, and by more than
/// their own size. A fast wheel, or degrees taken for radians, instead make large steps in a row.
std::vector<std::size_t> JumpsOf(const std::vector<double>& angle, double turn);

/// Whether an angle wraps after `turn`.
///
/// Model   all values lie within one turn and some steps exceed half of it. After unwrapping, these
///         steps are at most twice the others. A single wrong value would not continue to its
///         neighbours.
bool BeginsAnew(const std::vector<double>& angle, double turn);

/// Unwraps an angle that wraps after `turn`: each value moves by whole turns to within half a turn
/// of the previous one. Returns the number of rows at which the count of turns changes.
std::size_t Unwrap(double turn, std::vector<double>* angle);

}  // namespace tera
