#include "sensors/encoder/encoder_slots.h"

#include <algorithm>

#include "core/check.h"
#include "sensors/slots/report_clock.h"

namespace tera {

EncoderSlots::EncoderSlots(const Effects& effects, const std::vector<Effects>& axis_effects,
                           const std::vector<bool>& linear, const std::vector<std::string>& axes,
                           std::uint64_t seed, const std::string& stream_name)
    : ideal_(effects.empty() && std::all_of(axis_effects.begin(), axis_effects.end(),
                                            [](const Effects& e) { return e.empty(); })),
      filter_(effects),
      clock_(effects, seed, stream_name) {
  TERA_CHECK(linear.size() == axes.size(), linear.size(), axes.size());
  TERA_CHECK(axis_effects.empty() || axis_effects.size() == axes.size(), axis_effects.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Effects own = axis_effects.empty() ? Effects{} : axis_effects[i];
    axes_.emplace_back(EffectsOfAxis(effects, own), linear[i], seed, stream_name + "/" + axes[i]);
  }
}

void EncoderSlots::Apply(EncoderSample* sample) {
  if (ideal_) return;
  const std::int64_t k = next_++;
  const auto n = static_cast<Eigen::Index>(axes_.size());
  TERA_CHECK(sample->q_rad.size() == axes_.size(), sample->q_rad.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].Sense(sample->t_ns, &sample->q_rad[i], &sample->qd_radps[i]);
  }
  if (filter_.present()) {
    Eigen::Map<Eigen::VectorXd> q(sample->q_rad.data(), n), qd(sample->qd_radps.data(), n);
    Eigen::VectorXd x(2 * n);
    x << q, qd;
    const Eigen::VectorXd& y = filter_.Next(sample->t_ns, x);
    q = y.head(n);
    qd = y.tail(n);
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].ReadOut(k, &sample->q_rad[i], &sample->qd_radps[i]);
  }
  Restamp(clock_.Next(k, sample->t_ns), sample);
}

}  // namespace tera
