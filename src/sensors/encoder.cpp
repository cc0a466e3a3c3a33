#include "sensors/encoder.h"

#include <cmath>

#include "core/check.h"
#include "core/units.h"

namespace tera {

EncoderModel ReadEncoderModel(const ConfigMap& config) {
  EncoderModel m;
  m.joints = config.Texts("joints");
  m.resolution_rad = config.Number("resolution_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.noise_rad = config.Number("noise_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.rate_noise_radps = config.Number("rate_noise_degps", AtLeast(0, "deg/s"), 0) * kDeg;
  return m;
}

Encoder::Encoder(const EncoderModel& model, const SampleClock& clock, TimeNs latency_ns,
                 std::uint64_t seed, const std::string& stream_name)
    : model_(model),
      clock_(clock),
      latency_ns_(latency_ns),
      angle_(seed, stream_name + "/angle"),
      rate_(seed, stream_name + "/rate") {}

EncoderSample Encoder::Measure(std::int64_t k, const std::vector<double>& q_rad,
                               const std::vector<double>& qd_radps) const {
  TERA_CHECK(q_rad.size() == qd_radps.size(), q_rad.size(), qd_radps.size());
  EncoderSample sample;
  sample.t_ns = clock_.Due(k);
  sample.t_available_ns = sample.t_ns + latency_ns_;
  for (std::size_t i = 0; i < q_rad.size(); ++i) {
    const auto lane = static_cast<std::uint32_t>(i);
    double q = q_rad[i] + model_.noise_rad * angle_.Gaussian(k, lane);
    if (model_.resolution_rad > 0) {
      q = model_.resolution_rad * std::round(q / model_.resolution_rad);
    }
    sample.q_rad.push_back(q);
    sample.qd_radps.push_back(qd_radps[i] + model_.rate_noise_radps * rate_.Gaussian(k, lane));
  }
  return sample;
}

}  // namespace tera
