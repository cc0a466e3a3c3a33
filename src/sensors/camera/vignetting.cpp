#include "sensors/camera/vignetting.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

/// Area of a disc beyond a chord at distance `chord` from its centre, which may be negative.
double Segment(double radius, double chord) {
  const double c = std::clamp(chord / radius, -1.0, 1.0);
  return radius * radius * (std::acos(c) - c * std::sqrt(1 - c * c));
}

/// Common area of two discs with centre distance `apart`.
double CommonArea(double a, double b, double apart) {
  const double smaller = std::min(a, b);
  if (apart >= a + b) return 0;
  if (apart <= std::abs(a - b)) return kPi * smaller * smaller;
  const double chord = (apart * apart + a * a - b * b) / (2 * apart);  // from the centre of a
  return Segment(a, chord) + Segment(b, apart - chord);
}

}  // namespace

double PupilShare(const LensRim& rim, double pupil_radius_mm, double angle_rad) {
  if (angle_rad >= 0.5 * kPi) return 0;
  const double apart_mm = rim.distance_mm * std::tan(angle_rad);
  return CommonArea(pupil_radius_mm, rim.radius_mm, apart_mm) /
         (kPi * pupil_radius_mm * pupil_radius_mm);
}

}  // namespace tera
