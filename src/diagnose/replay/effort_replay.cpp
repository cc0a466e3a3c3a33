#include "diagnose/replay/effort_replay.h"

#include "physics/actuation/load_friction.h"

namespace tera {

std::vector<double> EffortReplay::Predict(const Effects& effects) const {
  const LoadFriction slot(
      LoadFrictionOf(effects, ActuatorEffort::Constant(model_.joints[log_.joint].max_effort_nm)));
  std::vector<double> against_nm;
  against_nm.reserve(log_.fine_rate_radps.size());
  for (const double rate_radps : log_.fine_rate_radps) {
    const AxisFriction friction = slot.Friction(rate_radps);
    const double dry_nm = rate_radps > 0   ? friction.against_positive_nm
                          : rate_radps < 0 ? -friction.against_negative_nm
                                           : 0.0;
    against_nm.push_back(dry_nm + friction.viscous_nmsprad * rate_radps + slot.Offset_nm());
  }
  std::vector<double> effort_nm;
  const std::size_t reach = log_.kernel.size() / 2;
  for (std::size_t k = 0; k < log_.at_fine.size(); ++k) {
    double sum_nm = log_.inertial_nm[k] + log_.weight_nm[k];
    const double* window = &against_nm[log_.at_fine[k] - reach];
    for (std::size_t i = 0; i < log_.kernel.size(); ++i) sum_nm += log_.kernel[i] * window[i];
    effort_nm.push_back(sum_nm);
  }
  return effort_nm;
}

}  // namespace tera
