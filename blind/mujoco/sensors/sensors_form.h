#pragma once

#include "blind/mujoco/machine/machine_numbers.h"

namespace tera::blind::mujoco {

/// Of a logger or sensor: its stamps are the true time and this.
struct ClockForm {
  double offset_s = 0;
  double lateness_s = 0;  ///< mean of what a stamp is late beside, exponentially distributed
  double drift = 0;       ///< seconds a second that the offset grows
  double set_s = 0;       ///< before this time, at which it is set, there is no offset

  double OffsetAt(double t_s) const { return t_s < set_s ? 0 : offset_s + drift * t_s; }
};

/// A plate that bends under a unit's weight (bracket.h).
struct BracketForm {
  double bends_rad = 0;  ///< under its weight along the link's z
  bool about_x = false;  ///< else about y
};

struct UnitForm {
  Vec3 gyro_radps = Vec3::Zero(), accelerometer_mps2 = Vec3::Zero();  ///< bias
  double warms_s = 0;    ///< bias comes as 1 - e^(-t / this); 0: it is there from the start
  double knocked_s = 0;  ///< bias comes at once, at this time
  ClockForm clock;
  BracketForm bracket;
};

/// One axis of a set of encoders.
struct EncoderForm {
  double zero_rad = 0;
  double warms_s = 0;  ///< within which the zero comes; 0: it is there from the start
  double angle_factor = 1, rate_factor = 1;  ///< below 0: counts the other way
  double ring_rad = 0;     ///< largest error of a ring off its centre: once a turn
  double ring_at_rad = 0;  ///< where that is
  double wound_1prad = 0;  ///< share of the factors by which a drum's cord changes them a radian
  double wound_from_rad = 0;

  bool operator==(const EncoderForm&) const = default;
};

struct ReceiverForm {
  ClockForm clock;
  Vec3 datum_m = Vec3::Zero();  ///< east, north, up
  double reflected_m = 0;       ///< what the boom's reflections pull the place by, at most
  double fringe_m = 0;          ///< over which that changes its sign; 0: it does not
  double shaded_m = 0;          ///< what satellites hidden by the boom push it away by, at most
  struct Truck {
    double pull_m = 0;  ///< as it passes
    double first_s = 0, every_s = 25;
    double towards_rad = 0;  ///< from east towards north
  } truck;
};

/// What is random in measurements.
struct NoiseForm {
  double gyro_radps = 0.012, accelerometer_mps2 = 0.25;  ///< white
  double gyro_slow_radps = 0.0003, accelerometer_slow_mps2 = 0.006;
  double engine_hz = 35, engine_mps2 = 0.15, engine_radps = 0.006;  ///< line, and its double
  double angle_rad = 0.0009, rate_radps = 0.022, track_radps = 0.08;
  double white_m = 0.007, white_up_m = 0.012, slow_m = 0.006, slow_up_m = 0.011;
  double tails = 0.004;       ///< share of samples with six times the noise
  double lost = 0.006;        ///< share of rows lost one by one
  double bursts_1ps = 0.03;   ///< rows lost in a run, so often
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
