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
  double resolution_m = 0, noise_m = 0, rate_noise_mps = 0;  ///< the same for prismatic joints
};

void Serialize(ModelArchive* archive, EncoderModel* model);

/// Encoders of several joints, tracks or wheels, sampled together.
///
/// Frames  Positions and rates are about each joint's own axis, from its zero; in metres for
///         prismatic joints.
/// Model   Position q + N(0, sigma^2), rounded to the nearest multiple of the resolution. Rate qd +
///         N(0, sigma_rate^2), independent of the rounded position.
/// Omits   Backlash, eccentricity, wrap-around of single-turn encoders. AxisErrors adds the zero
///         offset.
/// Source  Rounding: uniform error of variance resolution^2 / 12 for motion across many steps
///         (Bennett 1948, "Spectra of quantized signals").
class Encoder {
 public:
  /// `linear` marks the axes measured in metres. If it is empty, all axes are angles.
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
