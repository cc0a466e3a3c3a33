#pragma once

#include <mujoco/mujoco.h>

namespace tera::blind::mujoco {

/// Friction of a slewing ring, relative to that at a tilting moment of a quarter of weight times
/// diameter.
///
/// Frames  the joint's axis is the ring's.
/// Model   4.4 M + D F: M the tilting moment of the carried load, F its weight, D the diameter.
///         Friction grows with the arm's reach.
/// Omits   radial force, negligible for an excavator on its tracks.
/// Source  friction formula of thyssenkrupp rothe erde, Slewing bearings.
double RingFriction(const mjModel& model, const mjData& data, int joint, double diameter_m);

/// Half the play of a ring that is worn on one side, at the pinion's angle. Play over its mean is 1
/// + worn cos(angle - worst).
double HalfPlay_rad(double gap_rad, double worn, double worst_rad, double angle_rad);

}  // namespace tera::blind::mujoco
