#pragma once

namespace tera {

/// A lens's front rim, which shades its pupil for oblique light.
struct LensRim {
  double radius_mm = 10, distance_mm = 10;  ///< radius of the rim; distance from rim to pupil
};

/// Fraction of a pupil that oblique light reaches past the rim.
///
/// Model   Seen along the light, rim and pupil are two discs. Their centres are distance tan(angle)
///         apart. The fraction is the common area of the discs over the area of the pupil. No light
///         arrives beyond 90 degrees.
/// Omits   Pupil distortion; the rear rim, which cuts from the opposite side.
/// Source  Asada, Amano, Baba 1996, "Photometric calibration of zoom lens systems".
double PupilShare(const LensRim& rim, double pupil_radius_mm, double angle_rad);

}  // namespace tera
