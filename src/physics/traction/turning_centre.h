#pragma once

#include "physics/description/machine.h"

namespace tera {

/// How far from the middle of its tracks' contact a machine may turn because it does not bear on
/// them evenly: its upper structure and its arm carry its weight forward, back and aside.
///
/// Model   dry friction sideways under tracks whose load falls linearly along them changes its sign
///         where half of the load is on either side: 1.5 times as far from the middle as the centre
///         of mass, of which the largest distance over postures counts, with every joint at one of
///         its stops or, without stops, straight or turned by half.
/// Omits   grousers, and soil that is pushed aside; a load beyond a third of the half length lifts
///         an end of the tracks; joints after the twelfth.
/// Source  the median of a trapezoid of load, to first order in its slope; Wong, Theory of Ground
///         Vehicles, 4th ed. 2008, ch. 6, for its place in the turning of tracks.
double TurningCentreReach_m(const MachineModel& model);

}  // namespace tera
