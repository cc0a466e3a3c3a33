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
  double tilt_rad = 0;  ///< in (-pi, pi], but for bias and noise
  double tilt_radps = 0;
};

/// Its row: tilt_rad, tilt_radps.
std::vector<std::string> InclinometerColumns();
RowSample RowOf(const InclinometerSample& sample);

/// What an inclinometer does to the truth.
struct InclinometerModel {
  double time_constant_s = 0;          ///< of its low pass; 0: none
  double bias_rad = 0, noise_rad = 0;  ///< noise: 1 sigma of each sample
  double resolution_rad = 0;           ///< 0: not quantised
  double rate_bias_radps = 0, rate_noise_radps = 0;
  double vibration_rms_mps2 = 0;            ///< of the structure, along x and z of S each
  double vibration_rectification_s2pm = 0;  ///< shift along x for each square of that rms
};

void Serialize(ModelArchive* archive, InclinometerModel* model);

/// What its effects act on.
inline constexpr EffectTarget kInclinometerTarget{"an inclinometer"};

/// One accelerometer pair and one gyroscope that tell how far a link leans.
///
/// Frames  S sensor, x forward, y left, z up; y is the sensitive axis. The tilt is the turn of S
///         about y from where its z points up: positive where x points down, the pitch of a sensor
///         that leans about no other axis.
/// Model   f = mean specific force over the sample's interval + vibration, w = mean turn rate about
///         y. Vibration of rms a adds a n_x + k a^2 along x and a n_z along z, n standard normal. f
///         and w pass one first-order low pass with time constant tau; then
///         tilt = atan2(-f_x, f_z) + bias + noise, rounded to the resolution;
///         rate = w + rate bias + rate noise.
///         So the lag of a tilt is tau, and an acceleration a_x of the link for longer than tau
///         reads as a tilt of -atan(a_x / g).
/// Omits   fusion of both elements, which takes much of that error away; cross-axis sensitivity;
///         leaning about x, beyond what shortens f in the x-z plane.
/// Source  Luczak, Oleksiuk, Bodnicki 2006, "Sensing tilt with MEMS accelerometers", IEEE Sensors
///         Journal 6(6) (arc tangent of two axes); Analog Devices AN-1057 (errors by acceleration);
///         IEEE Std 1293-2018 (vibration rectification).
class Inclinometer {
 public:
  /// `stream_name` is the prefix of its noise streams, "excavator1/inclinometer_boom".
  Inclinometer(const InclinometerModel& model, std::uint64_t seed, const std::string& stream_name);
  /// Sample of an interval in which the link moved so, as an ideal inertial unit at S measures it.
  /// In the order of their times.
  InclinometerSample Measure(const ImuSample& motion);

 private:
  InclinometerModel model_;
  LowPass filter_;
  Stream vibration_, noise_, rate_noise_;
  std::uint64_t next_ = 0;
};

}  // namespace tera
