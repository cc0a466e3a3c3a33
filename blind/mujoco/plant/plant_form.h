#pragma once

#include <cstdint>
#include <string>

#include "blind/mujoco/machine/machine_numbers.h"
#include "blind/mujoco/plant/ground.h"

namespace tera::blind::mujoco {

/// How a message gets from the lever to the valve.
struct BusForm {
  double delay_s = 0;
  double jitter_s = 0;     ///< deviation of what each message is late beside
  int line_stages = 0;     ///< filters of MuJoCo's in a row that share the delay; 0: a queue
  double lost = 0;         ///< share of the messages
  double lost_in_row = 1;  ///< mean length of what is lost at once
};

/// How a drive answers to its lever. The defaults are a drive that does as it is told, but for the
/// spring of its oil.
struct DriveForm {
  BusForm bus;
  double gain = 1;            ///< of the rate
  double negative = 1;        ///< beside it, of negative levers
  double wave = 0;            ///< gain times 1 + wave sin(8 rad/rad * angle)
  double overlap = 0;         ///< of the spool, share of full lever
  double overlap_skew = 0;    ///< more of it for positive levers, less for negative ones
  double end = 1;             ///< where the valve ends
  double pilot_s = 0.004;     ///< of MuJoCo's filter before the valve
  double second_pilot_s = 0;  ///< of another one behind it; 0: none
  double oil_radps = 70;      ///< of the oil's spring with what it moves
  double droop = 0;           ///< share of the full rate that the rated load takes
  double leak = 0;            ///< share of the full rate that leaks past a piston at the rated load
  double motor_s = 0;    ///< 0: oil that holds a place; else a motor that holds a rate, by this
  double friction = 0;   ///< of such a motor, share of what gives the full rate
  double breakaway = 1;  ///< that friction at rest, over that in motion
  double gap_rad = 0;    ///< between the motor and what it turns
  int slowed_by = -1;    ///< another axis whose lever takes a share
  double slowed_share = 0;
  double cold_share = 0;  ///< lost at the start, of oil that warms within 15 s
  double sticking = 0;    ///< by which a lever must change before the spool moves
};

/// Ground under tracks: shoes that hold by bristles until they slide.
struct ShoeForm {
  double grip_along = 1, grip_across = 0.4;  ///< greatest force over load
  double relaxation_m = 0.05;  ///< of ground passed under a track until bristles are new
  double rolling = 0;          ///< resistance over load
  double gauge = 1;            ///< of the middle of contact, over the nominal
  double length = 1;           ///< of the contact, over the nominal
  double mud_slip = 0;         ///< share of its speed that a track loses in any case
};

/// Where a unit or antenna really is, beside its documented mount.
struct Misplaced {
  Vec3 xyz_m = Vec3::Zero();
  Vec3 rpy_rad = Vec3::Zero();
};

/// All of a machine that its owner's files do not say.
struct PlantForm {
  PerAxis<DriveForm> drives;
  ShoeForm shoes;
  Eigen::Vector2d sprocket = Eigen::Vector2d::Ones();  ///< radius over the nominal, left and right
  std::array<double, kLinkCount> mass{1, 1, 1, 1, 1};  ///< over the nominal
  double payload_kg = 0;                               ///< in the bucket
  std::array<Misplaced, kUnits> units;
  std::array<Misplaced, kReceivers> antennas;
};

/// What a drive starts from.
struct Start {
  Ground ground;
  double yaw_rad = 0;
  std::array<double, 4> joints_rad{};  ///< slew, boom, arm, bucket
};

}  // namespace tera::blind::mujoco
