#pragma once

#include <cstddef>
#include <vector>

namespace tera {

/// Sensors of angles that begin anew after a turn: 360 to 0, 180 to -180.

/// The rows, from the second on, to which an angle jumps: it differs from that of the row before by
/// more than half a turn of `turn`, in the angle's own unit, and this step differs by as much from
/// the steps before and after it, and by more than their own size. A wheel that turns on fast, and
/// angles in degrees that are taken for radians, take large steps one after the other.
std::vector<std::size_t> JumpsOf(const std::vector<double>& angle, double turn);

/// Whether angles jump because they begin anew after `turn`.
///
/// Model   all lie within one turn, some differ from the one before by more than half of it, and
///         these differ no more than others do where they go on instead: a single wrong value
///         would jump to where no neighbour goes on from.
bool BeginsAnew(const std::vector<double>& angle, double turn);

/// Lets angles go on where they begin anew after `turn`: each is by as many turns more or less as
/// bring it within half a turn of the one before. Returns at how many rows the number of turns
/// changes.
std::size_t Unwrap(double turn, std::vector<double>* angle);

}  // namespace tera
