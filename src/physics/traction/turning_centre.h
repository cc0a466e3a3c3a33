#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// Turning centre of a machine on the spot, relative to the centre of its tracks' contact
/// (TrackDrive::contact_B_m), forward and left. The two differ because the tracks' load is uneven:
/// upper structure and arm shift the weight.
///
/// Model   lateral dry friction under tracks with a linear load distribution. Its sign changes
///         where half of the load is on either side: at 1.5 times the distance of the centre of
///         mass from the middle.
/// Omits   grousers and displaced soil; a load offset beyond a third of the half length, which
///         lifts an end of the tracks.
/// Source  the median of a trapezoid of load, to first order in its slope; Wong, Theory of Ground
///         Vehicles, 4th ed. 2008, ch. 6, for its role in the turning of tracks.
Vec2 TurningCentre_m(const MachineModel& model, const Vec3& contact_B_m,
                     const std::vector<double>& q_rad);

/// Largest distance of that point from the contact's centre over postures. Each joint takes either
/// stop or, without stops, zero and half a turn. Joints after the twelfth keep their initial
/// positions.
double TurningCentreReach_m(const MachineModel& model);

}  // namespace tera
