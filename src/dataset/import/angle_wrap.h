#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Angles that wrap after a full turn, from 360 to 0 or from 180 to -180.

/// Indices of rows at which an angle jumps. A jump exceeds half of `turn`, a full turn in the
/// angle's unit. It must also differ by that much from the steps before and after it, and by more
/// than their own size. Thus a series of large steps, as of a fast wheel or of degrees read as
/// radians, contains no jumps.
std::vector<std::size_t> JumpsOf(const std::vector<double>& angle, double turn);

/// True if an angle wraps after `turn`.
///
/// Model   All values lie within one turn, and some steps exceed half a turn. After unwrapping,
///         these steps are at most twice as large as the other steps. A single wrong value fails
///         this test.
bool BeginsAnew(const std::vector<double>& angle, double turn);

/// Unwraps an angle: adds whole turns so that each value is within half a turn of the previous one.
/// Returns the number of rows at which the added turns change.
std::size_t Unwrap(double turn, std::vector<double>* angle);

}  // namespace tera
