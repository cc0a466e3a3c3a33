#pragma once

#include <string>
#include <vector>

#include "core/config.h"
#include "core/measurement.h"
#include "core/random.h"

namespace tera {

/// Angle sensors of several joints (or running gears) read together.
struct EncoderModel {
  std::vector<std::string> joints;  ///< joint or gear names; empty: all joints that move
  double resolution_rad = 0;        ///< 0: not quantised
  double noise_rad = 0;             ///< 1 sigma, before quantisation
  double rate_noise_radps = 0;
};

EncoderModel ReadEncoderModel(const ConfigMap& config);

class Encoder {
 public:
  Encoder(const EncoderModel& model, const SampleClock& clock, TimeNs latency_ns,
          std::uint64_t seed, const std::string& stream_name);
  EncoderSample Measure(std::int64_t k, const std::vector<double>& q_rad,
                        const std::vector<double>& qd_radps) const;

 private:
  EncoderModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream angle_, rate_;
};

}  // namespace tera
