#pragma once

#include <optional>
#include <string>

#include "core/effects.h"
#include "core/measurement.h"
#include "sensors/gnss.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// Angles of the machine that carries an antenna, as far as its signal depends on them.
struct BoomAndSlew {
  double boom_rad = 0, slew_rad = 0;
};

/// Reflections from the raised boom, `multipath`.
///
/// Frames  W east-north-up.
/// Model   e = max(0, sin(boom)) (h cos a, h sin a, v cos a), a = slew - `slew_phase_deg`: the
///         first harmonic of an error that has one maximum a turn and grows as the boom rises.
/// Omits   the satellites, and so the change over minutes; turning of the undercarriage; harmonics.
/// Source  an own low-order form; sizes after Georgiadou and Kleusberg 1988, "On carrier signal
///         multipath effects in relative GPS positioning" (a quarter wavelength, 4.8 cm, at most).
Vec3 MultipathError(const Effects& effects, const BoomAndSlew& angles);

/// Times without integer ambiguities, `float_jump`.
///
/// Model   a receiver with a fix loses it at the rate 1 / `interval_s` and has it back at the rate
///         1 / `duration_s`; in between its position is off by one draw of N(0, size^2) for each
///         axis, it reports "RTK float", and a variance that holds size^2 too.
/// Source  two-state Markov process; sizes of float solutions 0.1 to 0.5 m.
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

/// Slot `sensor_static` of a receiver.
///
/// Frames  W east-north-up about the site's origin.
/// Model   p + e_multipath + d + jump + o, rounded to the steps. d: `position_datum` (east, north)
///         and `height_datum` (up); o: `outliers`, N(0, size^2) with the given probability;
///         `quantisation` of east, north and up. Latitude, longitude and height follow. A sample
///         without a fix stays as it is.
/// Omits   datums that turn or scale the plane.
class GnssErrors {
 public:
  GnssErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// Sample `k`, in the order of their times.
  void Apply(std::int64_t k, const BoomAndSlew& angles, const SiteFrame& site, GnssSample* sample);

 private:
  Effects effects_;
  Vec3 datum_m_, outlier_m_, step_m_;
  OutlierDraw outliers_;
  FloatJumps jumps_;
};

}  // namespace tera
