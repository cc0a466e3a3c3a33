#pragma once

#include "blind/mujoco/machine/machine_numbers.h"

namespace tera::blind::mujoco {

/// Of a logger or sensor: its stamps are the true time and this.
struct ClockForm {
  double offset_s = 0;
  double lateness_s = 0;  ///< mean of what a stamp is late beside, exponentially distributed
};

struct UnitForm {
  Vec3 gyro_radps = Vec3::Zero(), accelerometer_mps2 = Vec3::Zero();  ///< bias
  double warms_s = 0;  ///< bias comes as 1 - e^(-t / this); 0: it is there from the start
  ClockForm clock;
};

/// One axis of a set of encoders.
struct EncoderForm {
  double zero_rad = 0;
  double warms_s = 0;  ///< within which the zero comes; 0: it is there from the start
  double angle_factor = 1, rate_factor = 1;  ///< below 0: counts the other way
  double eccentric_rad = 0;                  ///< of a disc off its centre: twice a turn
};

struct ReceiverForm {
  ClockForm clock;
  Vec3 datum_m = Vec3::Zero();  ///< east, north, up
  double reflected_m = 0;       ///< what the boom's reflections pull the place by, at most
  double fringe_m = 0;          ///< over which that changes its sign; 0: it does not
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
