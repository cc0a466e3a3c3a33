#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Point about which a machine turns on the spot, relative to the centre of its tracks' contact
/// (TrackDrive::contact_B_m), forward and left. Upper structure and arm make the load on the tracks
/// uneven and so shift this point.
///
/// Model   Lateral dry friction under tracks with a linear load distribution. Friction changes its
///         sign where half of the load is on either side. This is at 1.5 times the distance of the
///         centre of mass from the middle.
/// Omits   Grousers and displaced soil; a load offset of more than a third of the half length,
///         which lifts one end of the tracks.
/// Source  The median of a trapezoid of load, to first order in its slope; Wong, Theory of Ground
///         Vehicles, 4th ed. 2008, ch. 6, for its role in the turning of tracks.
Vec2 TurningCentre_m(const MachineModel& model, const Vec3& contact_B_m,
                     const std::vector<double>& q_rad);

/// Greatest distance of that point from the centre of the contact over postures. Each joint is at
/// either stop or, without stops, at zero and half a turn. Joints after the twelfth keep their
/// initial positions.
double TurningCentreReach_m(const MachineModel& model);

}  // namespace tera
