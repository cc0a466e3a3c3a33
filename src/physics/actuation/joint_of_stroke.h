#pragma once

#include "physics/description/machine.h"

namespace tera {

/// The position of a joint from the stroke of one of the cylinders that move it.
///
/// Model   the length between the pins (ReachOf) less the shortest over the joint's travel, solved
///         by bisection; beyond the travel straight on from its end.
/// Machines are read only where cylinders pass no dead centre, so that there is one such position.
double JointOfStroke(const MachineModel& model, const Cylinder& cylinder, double stroke_m);

/// The strokes at the ends of the joint's travel, the shorter one first, m.
struct StrokeRange {
  double least_m = 0, most_m = 0;
};
StrokeRange StrokesOf(const MachineModel& model, const Cylinder& cylinder);

}  // namespace tera
