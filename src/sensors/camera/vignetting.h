#pragma once

namespace tera {

/// A lens's front rim, which shades its pupil where light comes from the side.
struct LensRim {
  double radius_mm = 10, distance_mm = 10;  ///< of the rim, and from it to the pupil
};

/// The share of a pupil that light at an angle reaches past the rim.
///
/// Model   seen along the light, two discs whose centres are distance tan(angle) apart; the share
///         is their common area over the pupil's. No light beyond 90 degrees.
/// Omits   distortion of the pupil; the rear rim, which cuts from the other side.
/// Source  Asada, Amano, Baba 1996, "Photometric calibration of zoom lens systems".
double PupilShare(const LensRim& rim, double pupil_radius_mm, double angle_rad);

}  // namespace tera
