#include "sensors/inclinometer/inclinometer.h"

#include <cmath>

#include "core/units.h"
#include "sensors/slots/static_errors.h"

namespace tera {

std::vector<std::string> InclinometerColumns() { return {"tilt_rad", "tilt_radps"}; }

RowSample RowOf(const InclinometerSample& sample) {
  return {sample.t_ns, sample.t_available_ns, {sample.tilt_rad, sample.tilt_radps}};
}

void Serialize(ModelArchive* archive, InclinometerModel* m) {
  archive->Visit("time_constant_s", &m->time_constant_s, AtLeast(0, "s"));
  archive->Visit("bias_deg", &m->bias_rad, Any("deg"), kDeg);
  archive->Visit("noise_deg", &m->noise_rad, AtLeast(0, "deg"), kDeg);
  archive->Visit("resolution_deg", &m->resolution_rad, AtLeast(0, "deg"), kDeg);
  archive->Visit("rate_bias_degps", &m->rate_bias_radps, Any("deg/s"), kDeg);
  archive->Visit("rate_noise_degps", &m->rate_noise_radps, AtLeast(0, "deg/s"), kDeg);
  archive->Visit("vibration_rms_mps2", &m->vibration_rms_mps2, AtLeast(0, "m/s^2"));
  archive->Visit("vibration_rectification_s2pm", &m->vibration_rectification_s2pm, Any("s^2/m"));
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
