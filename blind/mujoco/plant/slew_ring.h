#pragma once

#include <mujoco/mujoco.h>

namespace tera::blind::mujoco {

/// How much friction a slewing ring has, over that at a tilting moment of a quarter of weight times
/// diameter.
///
/// Model   4.4 M + D F: M the moment by which what it carries would tilt, F its weight, D the
///         diameter. It rubs more while the arm reaches far.
/// Omits   radial force, which an excavator on its tracks hardly has.
/// Source  the ring makers' formula for friction, thyssenkrupp rothe erde, Slewing bearings.
/// Frames  the joint's axis is the ring's.
double RingFriction(const mjModel& model, const mjData& data, int joint, double diameter_m);

/// Half the play of a ring that is worn on one side, at the pinion's angle: play over that of all
/// around is 1 + worn cos(angle - worst).
double HalfPlay_rad(double gap_rad, double worn, double worst_rad, double angle_rad);

}  // namespace tera::blind::mujoco
