#pragma once

#include <optional>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Bias of an accelerometer under vibration, `vibration_rectification`.
///
/// Model   b = k (a_e^2 + s^2) for each axis. a_e is the rms of the engine's vibration. s^2 is the
///         variance of the magnitude of the specific force about its running mean. Both running
///         values are exponentially weighted with the time constant `window_s`.
/// Omits   Frequency dependence; different vibration levels of the axes.
/// Source  IEEE Std 1293-2018 (vibration rectification error, in g/g^2).
class VibrationShift {
 public:
  static std::optional<VibrationShift> Of(const Effects& effects);
  /// Bias at the next sample, whose specific force is `f_S_mps2`.
  Vec3 Next(TimeNs t_ns, const Vec3& f_S_mps2);

 private:
  Vec3 coefficient_s2pm_ = Vec3::Zero();
  double engine_rms_mps2_ = 0, window_s_ = 1;
  std::optional<TimeNs> last_ns_;
  double mean_mps2_ = 0, variance_m2ps4_ = 0;
};

/// Errors `sensor_static` of an inertial unit.
///
/// Model   Each axis reads m x + b + c dT(t) + v + o, clipped to +-limit, rounded to a multiple of
///         the step. x is the reading without these errors. m comes from `scale`, b from `bias`, c
///         dT(t) from `temperature_drift`, v from `vibration_rectification`. o comes from
///         `outliers`: N(0, size^2) on all axes at once with the given probability. `saturation`
///         clips, `quantisation` rounds.
/// Omits   Cross-axis sensitivity; g-sensitivity of the gyroscopes.
/// Source  Titterton and Weston 2004, ch. 4, 6 (forms of the errors).
class ImuErrors {
 public:
  /// `stream_name` is for example "excavator1/imu_boom".
  ImuErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Errors of the sensing elements: scale, bias, drift, vibration. Call it in the order of the
  /// samples.
  void Sense(ImuSample* sample);
  /// Errors of the read-out of sample `k`, after the filter: outliers, saturation, quantisation.
  void ReadOut(std::int64_t k, ImuSample* sample) const;

 private:
  /// Errors of three equal axes.
  struct Triad {
    Vec3 factor, bias, drift_per_k;
    double outlier = 0, limit = 0, step = 0;  ///< limit 0: no limit
    Vec3 Sense(const Vec3& measured, double warmer_k) const;
    Vec3 ReadOut(const Vec3& sensed) const;
  };

  Triad gyro_, accel_;
  WarmUp warm_up_;
  OutlierDraw outliers_;
  std::optional<VibrationShift> vibration_;
};

}  // namespace tera
