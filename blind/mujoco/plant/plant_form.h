#pragma once

#include <cstdint>
#include <string>

#include "blind/mujoco/machine/machine_numbers.h"
#include "blind/mujoco/plant/ground.h"

namespace tera::blind::mujoco {

/// Path of a message from lever to valve.
struct BusForm {
  double delay_s = 0;
  double jitter_s = 0;  ///< standard deviation of an additional delay of each message
  int line_stages = 0;  ///< number of MuJoCo's filters in series that share the delay; 0: a queue
  double slot_s = 0;    ///< slot of an arbitrated bus, upstream of the delay; 0: no arbitration
  double contested = 0.25;  ///< share of its slots that others win
  double lost = 0;          ///< share of the messages
  double lost_in_row = 1;   ///< mean length of what is lost at once
  double fades_hz = 0;      ///< greatest Doppler shift of a radio that loses that share; 0: in rows
};

/// Response of a drive to its lever. The defaults follow exactly, except for the oil's spring.
struct DriveForm {
  BusForm bus;
  double gain = 1;            ///< of the rate
  double positive = 1;        ///< further factor for positive levers
  double negative = 1;        ///< and for negative ones
  double hunts = 0;           ///< relative amplitude of a gain that oscillates
  double hunts_hz = 0.2;      ///< with this frequency
  double wave = 0;            ///< gain times 1 + wave sin(8 rad/rad * angle)
  double overlap = 0;         ///< of the spool, share of full lever
  double overlap_skew = 0;    ///< more overlap for positive levers, less for negative ones
  double soft = 0;            ///< lever range of a soft start above a threshold; 0: plain overlap
  double end = 1;             ///< where the valve ends
  double pilot_s = 0.004;     ///< of MuJoCo's filter before the valve
  double second_pilot_s = 0;  ///< second filter in series; 0: none
  double line_s = 0;          ///< delay of a long pilot hose; 0: short
  OilNumbers oil;             ///< spring after all of these
  double droop = 0;           ///< share of the full rate that the rated load costs
  double lifting_droop = 0;   ///< the same for an opposing load alone
  double leak = 0;            ///< share of the full rate that leaks past a piston at the rated load
  double motor_s = 0;         ///< time constant of a motor that holds a rate; 0: oil that holds a
                              ///< position
  double friction = 0;        ///< friction of such a motor, as a share of the effort at full rate
  double breakaway = 1;       ///< static over sliding friction
  bool ring_rubs = false;     ///< friction of a ring under a tilting load
  double gap_rad = 0;         ///< play between motor and driven part
  double gap_worn = 0;        ///< relative excess of the play at one angle, and deficit opposite
  double gap_worst_rad = 0;
  int slowed_by = -1;  ///< another axis whose lever takes a share
  double slowed_share = 0;
  double cold_share = 0;     ///< lost at the start, of oil that warms within 15 s
  double sticking = 0;       ///< change of lever that the spool needs to move
  double regenerates = 0;    ///< relative excess of rate for negative levers without load
  double runs_ahead = 0;     ///< relative excess of rate under a load that assists a negative
                             ///< lever, beyond the pump's flow
  double brake_opens_s = 0;  ///< of a brake that holds after a second at rest; 0: none
};

/// Ground under tracks: shoes that hold by bristles until they slide.
struct ShoeForm {
  double grip_along = 1, grip_across = 0.4;  ///< greatest force over load
  double relaxation_m = 0.05;                ///< length of ground after which bristles are new
  double rolling = 0;                        ///< resistance over load
  double gauge = 1;                          ///< of the middle of contact, over the nominal
  double length = 1;                         ///< of the contact, over the nominal
  double mud_slip = 0;                       ///< share of its speed that a track always loses
  std::array<double, 2> soft{1, 1};  ///< inverse relative relaxation length of the bristles, left
                                     ///< and right
  double drag_ahead = 0;             ///< drag of a blade in front of the tracks, over the machine's
                                     ///< weight
  double drag_back = 0;              ///< drag of the trailing blade
};

/// Actual mount of a unit or antenna, relative to the documented one.
struct Misplaced {
  Vec3 xyz_m = Vec3::Zero();
  Vec3 rpy_rad = Vec3::Zero();
};

/// All properties of a machine that its owner's files do not state.
struct PlantForm {
  PerAxis<DriveForm> drives;
  ShoeForm shoes;
  Eigen::Vector2d sprocket = Eigen::Vector2d::Ones();  ///< radius over the nominal, left and right
  Eigen::Vector2d packs = Eigen::Vector2d::Zero();     ///< share that mud adds to the radius during
                                                       ///< the drive
  std::array<double, kLinkCount> mass{1, 1, 1, 1, 1};  ///< over the nominal
  double payload_kg = 0;                               ///< in the bucket
  std::array<Misplaced, kUnits> units;
  std::array<Misplaced, kReceivers> antennas;
};

/// Initial state of a drive.
struct Start {
  Ground ground;
  double yaw_rad = 0;
  std::array<double, 4> joints_rad{};  ///< slew, boom, arm, bucket
};

}  // namespace tera::blind::mujoco
