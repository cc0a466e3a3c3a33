#pragma once

#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"

namespace tera {

/// Measured axes and accuracy of a set of encoders.
struct EncoderModel {
  std::vector<std::string> joints;  ///< joint or gear names; empty: all movable joints
  double resolution_rad = 0;        ///< 0: no quantisation
  double noise_rad = 0;             ///< 1 sigma, before quantisation
  double rate_noise_radps = 0;
  double resolution_m = 0, noise_m = 0, rate_noise_mps = 0;  ///< for prismatic joints
};

void Serialize(ModelArchive* archive, EncoderModel* model);

/// Angle and rate sensors of several joints, tracks or wheels, sampled together.
///
/// Frames  angles and rates about each joint's own axis, from its zero; metres for prismatic
///         joints.
/// Model   angle q + N(0, sigma^2), rounded to the nearest multiple of the resolution; rate
///         qd + N(0, sigma_rate^2), measured independently of the rounded angles.
/// Omits   backlash, eccentricity, single-turn wrap. (Zero offset: AxisErrors.)
/// Source  rounding: uniform error of variance resolution^2 / 12 (Bennett 1948, "Spectra of
///         quantized signals") for motion across many steps.
class Encoder {
 public:
  /// `linear` marks the axes measured in metres; empty: all are angles.
  Encoder(const EncoderModel& model, const SampleClock& clock, TimeNs latency_ns,
          std::uint64_t seed, const std::string& stream_name, std::vector<bool> linear = {});
  /// Sample k of axes at positions `q_rad` with rates `qd_radps`.
  EncoderSample Measure(std::int64_t k, const std::vector<double>& q_rad,
                        const std::vector<double>& qd_radps) const;

 private:
  EncoderModel model_;
  SampleClock clock_;
  TimeNs latency_ns_;
  Stream angle_, rate_;
  std::vector<bool> linear_;
};

}  // namespace tera
