#pragma once

#include <array>

#include "core/random.h"

namespace tera::blind::mujoco {

/// A radio link with multipath fading.
///
/// Model   Clarke's: paths from all directions, each with its own phase and the Doppler shift of
///         its direction. Power has the mean 1 and is exponentially distributed (Rayleigh fading).
///         It is below p for a share 1 - e^-p of the time, for (e^p - 1) / (f sqrt(2 pi p)) each
///         time on average. f is the greatest shift.
/// Omits   a direct path, the transmitter's retries.
/// Source  Rappaport 2002, Wireless Communications, eq. 5.80 and 5.84.
class Radio {
 public:
  /// Uses the lanes `lane` and `lane` + 1.
  Radio(double doppler_hz, const Stream& paths, std::uint32_t lane);

  double PowerAt(double t_s) const;
  /// Whether a message at this time is lost, for an overall share `lost`.
  bool Loses(double t_s, double lost) const;

 private:
  static constexpr std::size_t kPaths = 32;
  std::array<double, kPaths> shift_radps_{}, phase_rad_{};
};

}  // namespace tera::blind::mujoco
