#pragma once

#include <array>

#include "core/random.h"

namespace tera::blind::mujoco {

/// A radio link that fades as its waves come over many paths.
///
/// Model   Clarke's: paths from all around, each with a phase of its own and the Doppler shift
///         of its direction. Power has the mean 1 and is exponentially distributed (Rayleigh
///         fading), so it lies below p for a share 1 - e^-p of the time, each time for (e^p - 1) /
///         (f sqrt(2 pi p)) on average, f being the greatest shift.
/// Omits   a direct path, the transmitter's retries.
/// Source  Rappaport 2002, Wireless Communications, eq. 5.80 and 5.84.
class Radio {
 public:
  /// Takes `lane` and the one behind it.
  Radio(double doppler_hz, const Stream& paths, std::uint32_t lane);

  double PowerAt(double t_s) const;
  /// Whether what is sent then is lost, of a share `lost` of all.
  bool Loses(double t_s, double lost) const;

 private:
  static constexpr std::size_t kPaths = 32;
  std::array<double, kPaths> shift_radps_{}, phase_rad_{};
};

}  // namespace tera::blind::mujoco
