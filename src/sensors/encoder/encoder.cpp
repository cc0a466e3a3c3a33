#include "sensors/encoder/encoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace tera {

EncoderModel ReadEncoderModel(const ConfigMap& config) {
  EncoderModel m;
  m.joints = config.Texts("joints");
  std::set<std::string> seen;
  for (const std::string& joint : m.joints) {
    if (!seen.insert(joint).second) {
      config.Fault("joints", fmt::format("'{}' is named twice; keep one", joint));
    }
  }
  m.resolution_rad = config.Number("resolution_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.noise_rad = config.Number("noise_deg", AtLeast(0, "deg"), 0) * kDeg;
  m.rate_noise_radps = config.Number("rate_noise_degps", AtLeast(0, "deg/s"), 0) * kDeg;
  m.resolution_m = config.Number("resolution_m", AtLeast(0, "m"), 0);
  m.noise_m = config.Number("noise_m", AtLeast(0, "m"), 0);
  m.rate_noise_mps = config.Number("rate_noise_mps", AtLeast(0, "m/s"), 0);
  return m;
}

std::string EncoderModelYaml(const EncoderModel& m) {
  return fmt::format(
      "  joints: [{}]\n  resolution_deg: {:.12g}\n  noise_deg: {:.12g}\n  rate_noise_degps: "
      "{:.12g}\n  resolution_m: {}\n  noise_m: {}\n  rate_noise_mps: {}\n",
      fmt::join(m.joints, ", "), m.resolution_rad / kDeg, m.noise_rad / kDeg,
      m.rate_noise_radps / kDeg, m.resolution_m, m.noise_m, m.rate_noise_mps);
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
