#pragma once

#include "physics/description/machine.h"

namespace tera {

/// Position of a joint from the stroke of one of its cylinders.
///
/// Model   The distance between the pins (ReachOf) is inverted over the travel of the joint by
///         bisection, and extrapolated linearly beyond. The solution is unique, because the readers
///         refuse machines whose cylinders pass a dead centre.
double JointOfStroke(const MachineModel& model, const Cylinder& cylinder, double stroke_m);

/// Least and greatest stroke over the travel of the joint.
struct StrokeRange {
  double least_m = 0, most_m = 0;
};
StrokeRange StrokesOf(const MachineModel& model, const Cylinder& cylinder);

}  // namespace tera
