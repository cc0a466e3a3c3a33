#pragma once

#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"

namespace tera {

/// Which axes a set of encoders reads, and how well.
struct EncoderModel {
  std::vector<std::string> joints;  ///< joint or gear names; empty: all joints that move
  double resolution_rad = 0;        ///< 0: not quantised
  double noise_rad = 0;             ///< 1 sigma, before quantisation
  double rate_noise_radps = 0;
  double resolution_m = 0, noise_m = 0, rate_noise_mps = 0;  ///< of prismatic joints
};

void Serialize(ModelArchive* archive, EncoderModel* model);

/// Angle and rate sensors of several joints (or tracks, or wheels) read together.
///
/// Frames  angles and rates about each joint's own axis, from its zero; metres where it slides.
/// Model   angle q + N(0, sigma^2), rounded to the nearest multiple of the resolution; rate
///         qd + N(0, sigma_rate^2), measured by itself and not from the rounded angles.
/// Omits   backlash, eccentricity, the wrap of a single turn. (Zero offset: AxisErrors.)
/// Source  rounding: uniform error of variance resolution^2 / 12 (Bennett 1948, "Spectra of
///         quantized signals") where the motion passes many steps.
class Encoder {
 public:
  /// `linear` says of each axis whether it is measured in metres; none: all are angles.
  Encoder(const EncoderModel& model, const SampleClock& clock, TimeNs latency_ns,
          std::uint64_t seed, const std::string& stream_name, std::vector<bool> linear = {});
  /// Sample k of axes at `q_rad` that turn at `qd_radps`.
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
