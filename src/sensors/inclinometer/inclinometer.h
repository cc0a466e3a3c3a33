#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/low_pass.h"

namespace tera {

/// Tilt of a link about one axis, and its rate.
struct InclinometerSample {
  TimeNs t_ns = 0;
  TimeNs t_available_ns = 0;
  double tilt_rad = 0;  ///< in (-pi, pi] before bias and noise
  double tilt_radps = 0;
};

/// Row of a sample: tilt_rad, tilt_radps.
std::vector<std::string> InclinometerColumns();
RowSample RowOf(const InclinometerSample& sample);

/// Errors of an inclinometer.
struct InclinometerModel {
  double time_constant_s = 0;          ///< low pass; 0: none
  double bias_rad = 0, noise_rad = 0;  ///< noise: 1 sigma of each sample
  double resolution_rad = 0;           ///< 0: no quantisation
  double rate_bias_radps = 0, rate_noise_radps = 0;
  double vibration_rms_mps2 = 0;            ///< vibration of the structure, on each of x and z of S
  double vibration_rectification_s2pm = 0;  ///< shift along x per squared rms
};

void Serialize(ModelArchive* archive, InclinometerModel* model);

inline constexpr EffectTarget kInclinometerTarget{"an inclinometer"};

/// An accelerometer pair and a gyroscope that measure the tilt of a link.
///
/// Frames  S sensor, x forward, y left, z up; y is the sensitive axis. The tilt is the rotation of
///         S about y from the attitude with z up, positive if x points down. Without other rotation
///         it is the pitch of the sensor.
/// Model   f is the mean specific force over the interval of the sample plus vibration; w is the
///         mean angular rate about y. Vibration of rms a adds a n_x + k a^2 along x and a n_z along
///         z, with n standard normal. f and w pass the same first-order low pass with time constant
///         tau. Then tilt = atan2(-f_x, f_z) + bias + noise, rounded to the resolution, and rate =
///         w + rate bias + rate noise. The tilt lags by tau. An acceleration a_x of the link for
///         longer than tau reads as a tilt of -atan(a_x / g).
/// Omits   Fusion of both elements, which would remove much of that error; cross-axis sensitivity;
///         rotation about x, except that it shortens f in the x-z plane.
/// Source  Luczak, Oleksiuk, Bodnicki 2006, "Sensing tilt with MEMS accelerometers", IEEE Sensors
///         Journal 6(6) (arc tangent of two axes); Analog Devices AN-1057 (errors by acceleration);
///         IEEE Std 1293-2018 (vibration rectification).
class Inclinometer {
 public:
  /// `stream_name` is the prefix of its noise streams, for example "excavator1/inclinometer_boom".
  Inclinometer(const InclinometerModel& model, std::uint64_t seed, const std::string& stream_name);
  /// Sample of one interval. `motion` is the measurement of an ideal inertial unit at S. Call it in
  /// the order of the sample times.
  InclinometerSample Measure(const ImuSample& motion);

 private:
  InclinometerModel model_;
  LowPass filter_;
  Stream vibration_, noise_, rate_noise_;
  std::uint64_t next_ = 0;
};

}  // namespace tera
