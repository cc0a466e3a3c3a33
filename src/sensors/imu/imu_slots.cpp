#include "sensors/imu/imu_slots.h"

#include "sensors/slots/effect_numbers.h"
#include "sensors/slots/report_clock.h"

namespace tera {

Eigen::Matrix<double, 6, 1> AxisSigns(const Effects& effects) {
  const auto signs_of = [&](const char* x, const char* y, const char* z) -> Vec3 {
    return Vec3::Ones() - 2 * VectorOf(effects, "axis_flip", x, y, z);
  };
  const Vec3 both = signs_of("x", "y", "z");
  Eigen::Matrix<double, 6, 1> signs;
  signs << both.cwiseProduct(signs_of("gyro_x", "gyro_y", "gyro_z")),
      both.cwiseProduct(signs_of("accel_x", "accel_y", "accel_z"));
  return signs;
}

ImuSlots::ImuSlots(const Effects& effects, std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty()),
      axis_signs_(AxisSigns(effects)),
      errors_(effects, seed, stream_name),
      filter_(effects),
      clock_(effects, seed, stream_name) {}

void ImuSlots::Apply(ImuSample* sample) {
  if (ideal_) return;
  const std::int64_t k = next_++;
  sample->w_WS_S_radps = axis_signs_.head<3>().cwiseProduct(sample->w_WS_S_radps);
  sample->f_S_mps2 = axis_signs_.tail<3>().cwiseProduct(sample->f_S_mps2);
  errors_.Sense(sample);
  if (filter_.present()) {
    Eigen::VectorXd x(6);
    x << sample->w_WS_S_radps, sample->f_S_mps2;
    const Eigen::VectorXd& y = filter_.Next(sample->t_ns, x);
    sample->w_WS_S_radps = y.head<3>();
    sample->f_S_mps2 = y.tail<3>();
  }
  errors_.ReadOut(k, sample);
  Restamp(clock_.Next(k, sample->t_ns), sample);
}

}  // namespace tera
