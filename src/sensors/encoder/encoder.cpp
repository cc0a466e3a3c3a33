#include "sensors/encoder/encoder.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace tera {

void Serialize(ModelArchive* archive, EncoderModel* m) {
  archive->Visit("joints", &m->joints);
  std::set<std::string> seen;
  for (const std::string& joint : m->joints) {
    archive->Check(seen.insert(joint).second, "joints",
                   {FaultKind::kRepeated, fmt::format("'{}' is named twice; keep one", joint)});
  }
  archive->Visit("resolution_deg", &m->resolution_rad, AtLeast(0, "deg"), kDeg);
  archive->Visit("noise_deg", &m->noise_rad, AtLeast(0, "deg"), kDeg);
  archive->Visit("rate_noise_degps", &m->rate_noise_radps, AtLeast(0, "deg/s"), kDeg);
  archive->Visit("resolution_m", &m->resolution_m, AtLeast(0, "m"));
  archive->Visit("noise_m", &m->noise_m, AtLeast(0, "m"));
  archive->Visit("rate_noise_mps", &m->rate_noise_mps, AtLeast(0, "m/s"));
}

Encoder::Encoder(const EncoderModel& model, const SampleClock& clock, TimeNs latency_ns,
                 std::uint64_t seed, const std::string& stream_name, std::vector<bool> linear)
    : model_(model),
      clock_(clock),
      latency_ns_(latency_ns),
      angle_(seed, stream_name + "/angle"),
      rate_(seed, stream_name + "/rate"),
      linear_(std::move(linear)) {}

EncoderSample Encoder::Measure(std::int64_t k, const std::vector<double>& q_rad,
                               const std::vector<double>& qd_radps) const {
  TERA_CHECK(q_rad.size() == qd_radps.size(), q_rad.size(), qd_radps.size());
  TERA_CHECK(linear_.empty() || linear_.size() == q_rad.size(), linear_.size(), q_rad.size());
  EncoderSample sample;
  sample.t_ns = clock_.Due(k);
  sample.t_available_ns = sample.t_ns + latency_ns_;
  for (std::size_t i = 0; i < q_rad.size(); ++i) {
    const auto lane = static_cast<std::uint32_t>(i);
    const bool linear = !linear_.empty() && linear_[i];
    const double noise = linear ? model_.noise_m : model_.noise_rad;
    const double resolution = linear ? model_.resolution_m : model_.resolution_rad;
    const double rate_noise = linear ? model_.rate_noise_mps : model_.rate_noise_radps;
    double q = q_rad[i] + noise * angle_.Gaussian(k, lane);
    if (resolution > 0) q = resolution * std::round(q / resolution);
    sample.q_rad.push_back(q);
    sample.qd_radps.push_back(qd_radps[i] + rate_noise * rate_.Gaussian(k, lane));
  }
  return sample;
}

}  // namespace tera
