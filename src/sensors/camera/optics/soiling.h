#pragma once

#include <vector>

#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// A film of dust, specks of dirt and drops of water on the glass in front of a lens.
///
/// Frames  Positions on the glass are in image pixels: a position x mm off the axis covers the
///         pixel at f x / distance from the principal point. For angular lenses the glass is a
///         dome.
/// Model   Blur: matter on the glass is far out of focus. Its image is spread over a disc of
///         diameter A / distance, where A is the diameter of the pupil.
///         Dirt: the density of a film varies by smooth noise about its mean. A speck is a patch
///         with an uneven rim that absorbs most of the light. A film scatters the share kScattered
///         of the light that it removes, a speck kSpeckScattered. Scattered light comes uniformly
///         from the whole image, and from the sun as through a diffuse sheet.
///         Drops: a drop is a spherical cap of water that deflects rays by (n - 1) times its slope.
///         It shows the scene small and upside down.
///         Positions, sizes (log-normal) and shapes are drawn from the camera's random stream and
///         stay constant.
/// Omits   Colours of dirt; dispersion and reflections of drops; running drops; stronger deflection
///         than that of a thin prism.
/// Source  Disc of the pupil, attenuation plus scattered light: Gu, Ramamoorthi, Belhumeur, Nayar
///         2009, "Removing image artifacts due to dirty camera lenses and thin occluders";
///         refraction by a thin prism: any textbook of optics.
class Soiling {
 public:
  /// `pupil_mm` is the diameter of the pupil.
  Soiling(const SoilingModel& model, const CameraIntrinsics& camera, double pupil_mm,
          const Stream& draw, const std::string& stream_name);

  /// Transmittance of the glass for undeflected light, per pixel.
  const Image<float>& transmitted() const { return transmitted_; }
  /// Diameter of the disc over which the image of a point on the glass is spread.
  double disc_px() const { return disc_px_; }
  /// Image point shown by a pixel of a drop, relative to the centre of the drop. `sphere_mm` is the
  /// radius of the drop's sphere.
  static Vec2 Turned_px(const Vec2& from_middle_px, double px_per_mm, double focal_px,
                        double sphere_mm);

  /// `sun_lx` is the illuminance of the sun on the glass.
  void Apply(const Vec3& sun_lx, Image<float>* picture) const;

  static constexpr double kScattered = 0.4, kSpeckScattered = 0.04;
  static constexpr double kWater = 1.33;  ///< refractive index

 private:
  struct Spot {
    Vec2 middle_px;
    double radius_px;
    std::uint64_t number;
  };
  Spot SpotOf(std::uint64_t number, double median_mm, double spread, const Stream& draw) const;
  void AddFilm(double film, const std::string& stream_name);
  void AddSpeck(const Spot& spot, const Stream& draw);
  void AddDrop(const Spot& spot, const Stream& draw);
  void Spread(Image<float>* picture) const;

  CameraIntrinsics camera_;
  double px_per_mm_, disc_px_;
  Image<float> film_;         ///< transmittance of the film
  Image<float> specks_;       ///< transmittance of the specks
  Image<float> drops_;        ///< share covered by drops
  Image<float> source_px_;    ///< 2 channels: image point that a pixel of a drop shows
  Image<float> transmitted_;  ///< total transmittance
};

}  // namespace tera
