#pragma once

#include <optional>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/gnss/gnss.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// A reflecting part that rises near an antenna, for example a boom or a lift arm.
struct RaisedBoom {
  /// Unit vector from foot to tip; 0 without a reflector.
  Vec3 direction_W = Vec3::Zero();
};

/// Multipath error from a raised boom, `multipath`.
///
/// Frames  W east-north-up.
/// Model   e = max(0, sin(elevation)) (h cos a, h sin a, v cos a), where a = azimuth -
///         `azimuth_deg`. Elevation and azimuth are those of the boom; azimuth is from east to
///         north. The error grows with the boom's elevation. Over a full turn of the boom's
///         azimuth, the error is a first harmonic.
/// Omits   Satellites, and hence changes over minutes; higher harmonics; a vertical boom, whose
///         azimuth is undefined.
/// Source  Low-order form of this project. Sizes: Georgiadou and Kleusberg 1988, "On carrier signal
///         multipath effects in relative GPS positioning" (at most a quarter wavelength, 4.8 cm).
Vec3 MultipathError(const Effects& effects, const RaisedBoom& boom);

/// Periods without integer ambiguities, `float_jump`.
///
/// Model   A receiver loses its fix at the rate 1 / `interval_s` and recovers it at the rate 1 /
///         `duration_s`. Without the fix, each axis has an offset drawn from N(0, size^2), constant
///         over the period. The receiver then reports "RTK float" and adds size^2 to the variance.
/// Source  Two-state Markov process; sizes of float solutions 0.1 to 0.5 m.
class FloatJumps {
 public:
  FloatJumps(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  void Apply(std::int64_t k, GnssSample* sample);

 private:
  Stream stream_;
  bool present_ = false, floating_ = false;
  double interval_s_ = 1, duration_s_ = 1;
  Vec3 sigma_m_ = Vec3::Zero(), offset_m_ = Vec3::Zero();
  std::optional<TimeNs> last_ns_;
};

/// Errors `sensor_static` of a receiver.
///
/// Frames  W east-north-up about the origin of the site.
/// Model   Signal: p + e_multipath + d + jump, where d is `position_datum` (east, north) and
///         `height_datum` (up). Read-out, after the filter: + o, rounded to steps. o comes from
///         `outliers`: N(0, size^2) with the given probability. `quantisation` rounds east, north
///         and up. A sample without a fix does not change.
/// Omits   Datum rotation and scale.
class GnssErrors {
 public:
  GnssErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Signal errors of sample `k`. Call it in the order of the sample times. Both functions change
  /// `enu_m`; the caller updates latitude, longitude and height.
  void Sense(std::int64_t k, const RaisedBoom& boom, GnssSample* sample);
  void ReadOut(std::int64_t k, GnssSample* sample) const;

 private:
  Effects effects_;
  Vec3 datum_m_, outlier_m_, step_m_;
  OutlierDraw outliers_;
  FloatJumps jumps_;
};

}  // namespace tera
