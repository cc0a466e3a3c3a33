#include "sensors/imu/imu_slots.h"

#include "sensors/slots/effect_numbers.h"
#include "sensors/slots/report_clock.h"

namespace tera {

Vec3 AxisSigns(const Effects& effects) {
  return Vec3::Ones() - 2 * VectorOf(effects, "axis_flip", "x", "y", "z");
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
  sample->w_WS_S_radps = axis_signs_.cwiseProduct(sample->w_WS_S_radps);
  sample->f_S_mps2 = axis_signs_.cwiseProduct(sample->f_S_mps2);
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
