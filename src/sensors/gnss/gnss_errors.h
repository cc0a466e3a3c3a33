#pragma once

#include <optional>
#include <string>

#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "sensors/gnss/gnss.h"
#include "sensors/slots/static_errors.h"

namespace tera {

/// What rises beside an antenna and reflects: a boom, a lift arm.
struct RaisedBoom {
  /// From its foot to its tip, length 1; 0 where nothing reflects.
  Vec3 direction_W = Vec3::Zero();
};

/// Reflections from a raised boom, `multipath`.
///
/// Frames  W east-north-up.
/// Model   e = max(0, sin(elevation)) (h cos a, h sin a, v cos a), a = azimuth - `azimuth_deg`,
///         both of the boom, the azimuth from east towards north: the first harmonic of an error
///         that has one maximum a turn and grows as the boom rises.
/// Omits   the satellites, and so the change over minutes; harmonics; a boom straight up, whose
///         azimuth is any.
/// Source  an own low-order form; sizes after Georgiadou and Kleusberg 1988, "On carrier signal
///         multipath effects in relative GPS positioning" (a quarter wavelength, 4.8 cm, at most).
Vec3 MultipathError(const Effects& effects, const RaisedBoom& boom);

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
/// Model   of the signal: p + e_multipath + d + jump. d: `position_datum` (east, north) and
///         `height_datum` (up). Of what is read out, behind a filter: + o, rounded to the steps.
///         o: `outliers`, N(0, size^2) with the given probability; `quantisation` of east, north
///         and up. A sample without a fix stays as it is.
/// Omits   datums that turn or scale the plane.
class GnssErrors {
 public:
  GnssErrors(const Effects& effects, std::uint64_t seed, const std::string& stream_name);
  /// The signal of sample `k`, in the order of their times. These two change `enu_m`, and leave
  /// latitude, longitude and height to the caller.
  void Sense(std::int64_t k, const RaisedBoom& boom, GnssSample* sample);
  void ReadOut(std::int64_t k, GnssSample* sample) const;

 private:
  Effects effects_;
  Vec3 datum_m_, outlier_m_, step_m_;
  OutlierDraw outliers_;
  FloatJumps jumps_;
};

}  // namespace tera
