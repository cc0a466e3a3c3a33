#include "sensors/inclinometer/inclinometer.h"

#include <fmt/format.h>

#include <cmath>

#include "core/check.h"
#include "core/units.h"
#include "sensors/slots/static_errors.h"

namespace tera {

std::vector<std::string> InclinometerColumns() { return {"tilt_rad", "tilt_radps"}; }

RowSample RowOf(const InclinometerSample& sample) {
  return {sample.t_ns, sample.t_available_ns, {sample.tilt_rad, sample.tilt_radps}};
}

InclinometerSample InclinometerSampleOf(const RowSample& row) {
  TERA_CHECK(row.values.size() == 2, row.values.size());
  return {row.t_ns, row.t_available_ns, row.values[0], row.values[1]};
}

InclinometerModel ReadInclinometerModel(const ConfigMap& config) {
  InclinometerModel m;
  m.time_constant_s = config.Number("time_constant_s", AtLeast(0, "s"), 0);
  m.bias_rad = config.Number("bias_deg", Any("deg"), 0) * kDeg;
  m.noise_rad = config.Number("noise_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.resolution_rad = config.Number("resolution_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.rate_bias_radps = config.Number("rate_bias_degps", Any("deg/s"), 0) * kDeg;
  m.rate_noise_radps = config.Number("rate_noise_degps", AtLeast(0, "deg/s"), 0) * kDeg;
  m.vibration_rms_mps2 = config.Number("vibration_rms_mps2", AtLeast(0, "m/s^2"), 0);
  m.vibration_rectification_s2pm = config.Number("vibration_rectification_s2pm", Any("s^2/m"), 0);
  return m;
}

std::string InclinometerModelYaml(const InclinometerModel& m) {
  return fmt::format(
      "  time_constant_s: {}\n  bias_deg: {:.12g}\n  noise_deg: {:.12g}\n  resolution_deg: "
      "{:.12g}\n  rate_bias_degps: {:.12g}\n  rate_noise_degps: {:.12g}\n  vibration_rms_mps2: "
      "{}\n  vibration_rectification_s2pm: {}\n",
      m.time_constant_s, m.bias_rad / kDeg, m.noise_rad / kDeg, m.resolution_rad / kDeg,
      m.rate_bias_radps / kDeg, m.rate_noise_radps / kDeg, m.vibration_rms_mps2,
      m.vibration_rectification_s2pm);
}

Inclinometer::Inclinometer(const InclinometerModel& model, std::uint64_t seed,
                           const std::string& stream_name)
    : model_(model),
      filter_(model.time_constant_s),
      vibration_(seed, stream_name + "/vibration"),
      noise_(seed, stream_name + "/tilt"),
      rate_noise_(seed, stream_name + "/rate") {}

InclinometerSample Inclinometer::Measure(const ImuSample& motion) {
  const std::uint64_t k = next_++;
  const double rms_mps2 = model_.vibration_rms_mps2;
  const double shift_mps2 = model_.vibration_rectification_s2pm * rms_mps2 * rms_mps2;
  Eigen::VectorXd sensed(3);
  sensed << motion.f_S_mps2.x() + shift_mps2, motion.f_S_mps2.z(), motion.w_WS_S_radps.y();
  if (rms_mps2 > 0) sensed.head<2>() += rms_mps2 * vibration_.Gaussian3(k).head<2>();
  if (filter_.present()) sensed = Eigen::VectorXd(filter_.Next(motion.t_ns, sensed));
  const double tilt_rad =
      std::atan2(-sensed[0], sensed[1]) + model_.bias_rad + model_.noise_rad * noise_.Gaussian(k);
  return {motion.t_ns, motion.t_available_ns, Quantised(tilt_rad, model_.resolution_rad),
          sensed[2] + model_.rate_bias_radps + model_.rate_noise_radps * rate_noise_.Gaussian(k)};
}

}  // namespace tera
