#pragma once

#include "blind/mujoco/machine/machine_numbers.h"

namespace tera::blind::mujoco {

/// Clock of a logger or sensor: its stamp minus the true time.
struct ClockForm {
  double offset_s = 0;
  double lateness_s = 0;  ///< mean of an additional, exponentially distributed delay of stamps
  double drift = 0;       ///< growth of the offset, s/s
  double set_s = 0;       ///< time at which the clock is set; before it there is no offset

  double OffsetAt(double t_s) const { return t_s < set_s ? 0 : offset_s + drift * t_s; }
};

/// A plate that bends under a unit's weight (bracket.h).
struct BracketForm {
  double bends_rad = 0;  ///< under its weight along the link's z
  bool about_x = false;  ///< else about y
};

struct UnitForm {
  Vec3 gyro_radps = Vec3::Zero(), accelerometer_mps2 = Vec3::Zero();  ///< bias
  double warms_s = 0;    ///< bias grows as 1 - e^(-t / this); 0: constant
  double knocked_s = 0;  ///< the bias appears at this time
  ClockForm clock;
  BracketForm bracket;
};

/// One axis of a set of encoders.
struct EncoderForm {
  double zero_rad = 0;
  double warms_s = 0;                        ///< time constant of the zero's growth; 0: constant
  double angle_factor = 1, rate_factor = 1;  ///< negative: inverted sign
  double ring_rad = 0;                       ///< largest error of an eccentric ring, once a turn
  double ring_at_rad = 0;                    ///< angle of that error
  double wound_1prad = 0;  ///< relative change of the factors per radian, by a drum's cord
  double wound_from_rad = 0;

  bool operator==(const EncoderForm&) const = default;
};

struct ReceiverForm {
  ClockForm clock;
  Vec3 datum_m = Vec3::Zero();  ///< east, north, up
  double reflected_m = 0;       ///< largest position error from the boom's reflections
  double fringe_m = 0;          ///< distance over which that error changes sign; 0: constant
  double shaded_m = 0;          ///< largest position error from satellites hidden by the boom
  struct Truck {
    double pull_m = 0;  ///< as it passes
    double first_s = 0, every_s = 25;
    double towards_rad = 0;  ///< from east towards north
  } truck;
};

/// Random errors of measurements.
struct NoiseForm {
  double gyro_radps = 0.012, accelerometer_mps2 = 0.25;  ///< white
  double gyro_slow_radps = 0.0003, accelerometer_slow_mps2 = 0.006;
  double engine_hz = 35, engine_mps2 = 0.15, engine_radps = 0.006;  ///< line, and its double
  double angle_rad = 0.0009, rate_radps = 0.022, track_radps = 0.08;
  double white_m = 0.007, white_up_m = 0.012, slow_m = 0.006, slow_up_m = 0.011;
  double tails = 0.004;       ///< share of samples with six times the noise
  double lost = 0.006;        ///< share of rows lost one by one
  double bursts_1ps = 0.03;   ///< rate of runs of lost rows
  double floats_1ps = 0.004;  ///< episodes without fixed ambiguities
  double jitter_s = 0.0006;   ///< of stamps
};

struct SensorsForm {
  std::array<UnitForm, kUnits> units;
  PerAxis<EncoderForm> encoders;
  ClockForm joint_clock, track_clock;
  std::array<ReceiverForm, kReceivers> receivers;
  NoiseForm noise;
};

}  // namespace tera::blind::mujoco
