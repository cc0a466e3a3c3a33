#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Position of a joint from the stroke of one of its cylinders.
///
/// Model   the length between the pins (ReachOf) minus the shortest over the joint's travel, solved
///         by bisection; extrapolated linearly beyond the travel.
/// The solution is unique, since the readers refuse machines whose cylinders pass a dead centre.
double JointOfStroke(const MachineModel& model, const Cylinder& cylinder, double stroke_m);

/// Strokes at the ends of the joint's travel, the shorter one first, m.
struct StrokeRange {
  double least_m = 0, most_m = 0;
};
StrokeRange StrokesOf(const MachineModel& model, const Cylinder& cylinder);

}  // namespace tera
