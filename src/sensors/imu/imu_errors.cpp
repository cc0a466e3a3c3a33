#include "sensors/imu/imu_errors.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {

std::optional<VibrationShift> VibrationShift::Of(const Effects& effects) {
  const Effect* effect = FindEffect(effects, "vibration_rectification");
  if (!effect) return std::nullopt;
  VibrationShift shift;
  shift.coefficient_s2pm_ = Vec3((*effect)["x_s2pm"], (*effect)["y_s2pm"], (*effect)["z_s2pm"]);
  shift.engine_rms_mps2_ = (*effect)["engine_rms_mps2"];
  shift.window_s_ = (*effect)["window_s"];
  return shift;
}

Vec3 VibrationShift::Next(TimeNs t_ns, const Vec3& f_S_mps2) {
  const double force_mps2 = f_S_mps2.norm();
  if (!last_ns_) {
    mean_mps2_ = force_mps2;
  } else {
    const double gain = -std::expm1(-ToSeconds(t_ns - *last_ns_) / window_s_);
    const double away_mps2 = force_mps2 - mean_mps2_;
    mean_mps2_ += gain * away_mps2;
    // Exponentially weighted variance about the mean (West 1979).
    variance_m2ps4_ = (1 - gain) * (variance_m2ps4_ + gain * away_mps2 * away_mps2);
  }
  last_ns_ = t_ns;
  return coefficient_s2pm_ * (engine_rms_mps2_ * engine_rms_mps2_ + variance_m2ps4_);
}

ImuErrors::ImuErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : warm_up_(WarmUp::Of(effects)),
      outliers_(effects, seed, stream_name),
      vibration_(VibrationShift::Of(effects)) {
  const auto number = [&](std::string_view id, std::string_view parameter) {
    return NumberOf(effects, id, parameter, 0);
  };
  gyro_.factor = VectorOf(effects, "scale", "gyro_x_factor", "gyro_y_factor", "gyro_z_factor", 1);
  gyro_.bias = VectorOf(effects, "bias", "gyro_x_degps", "gyro_y_degps", "gyro_z_degps") * kDeg;
  gyro_.drift_per_k =
      VectorOf(effects, "temperature_drift", "gyro_x_degpspk", "gyro_y_degpspk", "gyro_z_degpspk") *
      kDeg;
  gyro_.outlier = number("outliers", "gyro_degps") * kDeg;
  gyro_.limit = number("saturation", "gyro_limit_degps") * kDeg;
  gyro_.step = number("quantisation", "gyro_step_degps") * kDeg;
  accel_.factor =
      VectorOf(effects, "scale", "accel_x_factor", "accel_y_factor", "accel_z_factor", 1);
  accel_.bias = VectorOf(effects, "bias", "accel_x_mps2", "accel_y_mps2", "accel_z_mps2");
  accel_.drift_per_k =
      VectorOf(effects, "temperature_drift", "accel_x_mps2pk", "accel_y_mps2pk", "accel_z_mps2pk");
  accel_.outlier = number("outliers", "accel_mps2");
  accel_.limit = number("saturation", "accel_limit_mps2");
  accel_.step = number("quantisation", "accel_step_mps2");
}

Vec3 ImuErrors::Triad::Sense(const Vec3& measured, double warmer_k) const {
  return factor.cwiseProduct(measured) + bias + warmer_k * drift_per_k;
}

Vec3 ImuErrors::Triad::ReadOut(const Vec3& sensed) const {
  Vec3 x = sensed;
  for (double& axis : x) {
    if (limit > 0) axis = std::clamp(axis, -limit, limit);
    axis = Quantised(axis, step);
  }
  return x;
}

void ImuErrors::Sense(ImuSample* sample) {
  const double warmer_k = warm_up_.At(sample->t_ns);
  Vec3 shift = Vec3::Zero();
  if (vibration_) shift = vibration_->Next(sample->t_ns, sample->f_S_mps2);
  sample->w_WS_S_radps = gyro_.Sense(sample->w_WS_S_radps, warmer_k);
  sample->f_S_mps2 = accel_.Sense(sample->f_S_mps2, warmer_k) + shift;
}

void ImuErrors::ReadOut(std::int64_t k, ImuSample* sample) const {
  const auto index = static_cast<std::uint64_t>(k);
  if (outliers_.At(index)) {
    sample->w_WS_S_radps += gyro_.outlier * outliers_.Gaussian3(index, 1);
    sample->f_S_mps2 += accel_.outlier * outliers_.Gaussian3(index, 2);
  }
  sample->w_WS_S_radps = gyro_.ReadOut(sample->w_WS_S_radps);
  sample->f_S_mps2 = accel_.ReadOut(sample->f_S_mps2);
}

}  // namespace tera
