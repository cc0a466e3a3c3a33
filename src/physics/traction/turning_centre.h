#pragma once

#include <vector>

#include "physics/description/machine.h"

namespace tera {

/// The point about which a machine turns on the spot, from the middle of its tracks' contact
/// (TrackDrive::contact_B_m), forward and to the left. It lies off that middle because the machine
/// does not bear on its tracks evenly: its upper structure and its arm carry its weight forward,
/// back and aside.
///
/// Model   dry friction sideways under tracks whose load falls linearly along them changes its sign
///         where half of the load is on either side: 1.5 times as far from the middle as the centre
///         of mass.
/// Omits   grousers, and soil that is pushed aside; a load beyond a third of the half length, which
///         lifts an end of the tracks.
/// Source  the median of a trapezoid of load, to first order in its slope; Wong, Theory of Ground
///         Vehicles, 4th ed. 2008, ch. 6, for its place in the turning of tracks.
Vec2 TurningCentre_m(const MachineModel& model, const Vec3& contact_B_m,
                     const std::vector<double>& q_rad);

/// The largest distance of that point over postures, with every joint at one of its stops or,
/// without stops, straight or turned by half. Joints after the twelfth stay as they are at first.
double TurningCentreReach_m(const MachineModel& model);

}  // namespace tera
