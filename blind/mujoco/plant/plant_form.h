#pragma once

#include <cstdint>
#include <string>

#include "blind/mujoco/machine/machine_numbers.h"
#include "blind/mujoco/plant/ground.h"

namespace tera::blind::mujoco {

/// How a message gets from the lever to the valve.
struct BusForm {
  double delay_s = 0;
  double jitter_s = 0;  ///< deviation of what each message is late beside
  int line_stages = 0;  ///< filters of MuJoCo's in a row that share the delay; 0: a queue
  double slot_s = 0;    ///< of a bus whose frames are arbitrated, before the delay; 0: it is free
  double contested = 0.25;  ///< share of its slots that others win
  double lost = 0;          ///< share of the messages
  double lost_in_row = 1;   ///< mean length of what is lost at once
  double fades_hz = 0;      ///< greatest Doppler shift of a radio that loses that share; 0: in rows
};

/// How a drive answers to its lever. The defaults are a drive that does as it is told, but for the
/// spring of its oil.
struct DriveForm {
  BusForm bus;
  double gain = 1;            ///< of the rate
  double positive = 1;        ///< beside it, of positive levers
  double negative = 1;        ///< and of negative ones
  double hunts = 0;           ///< share by which the gain goes up and down
  double hunts_hz = 0.2;      ///< so often
  double wave = 0;            ///< gain times 1 + wave sin(8 rad/rad * angle)
  double overlap = 0;         ///< of the spool, share of full lever
  double overlap_skew = 0;    ///< more of it for positive levers, less for negative ones
  double soft = 0;            ///< over which a spool behind a threshold lets go; 0: it overlaps
  double end = 1;             ///< where the valve ends
  double pilot_s = 0.004;     ///< of MuJoCo's filter before the valve
  double second_pilot_s = 0;  ///< of another one behind it; 0: none
  double line_s = 0;          ///< by which a long pilot hose is late; 0: short
  OilNumbers oil;             ///< the spring behind all that
  double droop = 0;           ///< share of the full rate that the rated load takes
  double lifting_droop = 0;   ///< that it takes where it is against the motion, and there alone
  double leak = 0;            ///< share of the full rate that leaks past a piston at the rated load
  double motor_s = 0;      ///< 0: oil that holds a place; else a motor that holds a rate, by this
  double friction = 0;     ///< of such a motor, share of what gives the full rate
  double breakaway = 1;    ///< that friction at rest, over that in motion
  bool ring_rubs = false;  ///< its friction is that of a ring under a tilting load
  double gap_rad = 0;      ///< between the motor and what it turns
  double gap_worn = 0;     ///< share by which the gap is wider at one angle, narrower across
  double gap_worst_rad = 0;
  int slowed_by = -1;  ///< another axis whose lever takes a share
  double slowed_share = 0;
  double cold_share = 0;     ///< lost at the start, of oil that warms within 15 s
  double sticking = 0;       ///< by which a lever must change before the spool moves
  double regenerates = 0;    ///< share of the rate more, negative levers without load
  double runs_ahead = 0;     ///< share by which a load that aids a negative lever outruns the pump
  double brake_opens_s = 0;  ///< of a brake that holds after a second at rest; 0: none
};

/// Ground under tracks: shoes that hold by bristles until they slide.
struct ShoeForm {
  double grip_along = 1, grip_across = 0.4;  ///< greatest force over load
  double relaxation_m = 0.05;        ///< of ground passed under a track until bristles are new
  double rolling = 0;                ///< resistance over load
  double gauge = 1;                  ///< of the middle of contact, over the nominal
  double length = 1;                 ///< of the contact, over the nominal
  double mud_slip = 0;               ///< share of its speed that a track loses in any case
  std::array<double, 2> soft{1, 1};  ///< how much sooner bristles are new, left and right
  double drag_ahead = 0;             ///< of a blade before the tracks, over the machine's weight
  double drag_back = 0;              ///< as it trails behind
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
  Eigen::Vector2d packs = Eigen::Vector2d::Zero();     ///< share that mud adds to it under way
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
