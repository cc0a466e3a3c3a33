#pragma once

#include <vector>

#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/camera_intrinsics.h"
#include "sensors/camera/optics/optics_model.h"

namespace tera {

/// A film of dust, specks of dirt and drops of water on the glass before a lens.
///
/// Frames  places on the glass in pixels of the picture: one at x mm from the axis covers the pixel
///         that is f x / distance from the principal point. Angular lenses stand behind a dome.
/// Model   What lies on the glass is far out of focus: its picture is spread over a disc of the
///         diameter A / distance, A the pupil's. A film is denser and thinner by smooth noise about
///         its mean; a speck is a patch with an uneven rim that takes most of the light. Of the
///         light that a film takes, kScattered arrives evenly from the whole picture, and of the
///         sun's on the glass as from a diffuse sheet; of what a speck takes kSpeckScattered. A
///         drop is a cap of a sphere of water, which turns rays by (n - 1) times its slope: it
///         shows the scene small and upside down. Places, sizes (log-normal) and shapes are drawn
///         from the camera's stream; they stay.
/// Omits   colours of dirt; dispersion and reflections of drops; drops that run; rays through a
///         drop that would be turned by more than its slope allows.
/// Source  the pupil's disc and attenuation plus scattered light: Gu, Ramamoorthi, Belhumeur,
///         Nayar 2009, "Removing image artifacts due to dirty camera lenses and thin occluders";
///         refraction by a thin prism: any textbook of optics.
class Soiling {
 public:
  /// `pupil_mm` is the pupil's diameter.
  Soiling(const SoilingModel& model, const CameraIntrinsics& camera, double pupil_mm,
          const Stream& draw, const std::string& stream_name);

  /// The share of a pixel's own light that comes through, undeviated.
  const Image<float>& transmitted() const { return transmitted_; }
  /// Diameter of the disc that a point on the glass makes.
  double disc_px() const { return disc_px_; }
  /// Where in the picture a drop's pixel looks, from its middle, and its radius (of a sphere).
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
  Image<float> film_;         ///< share that a film lets through
  Image<float> specks_;       ///< and that specks do
  Image<float> drops_;        ///< share of drops
  Image<float> source_px_;    ///< 2 channels: what a drop's pixel shows
  Image<float> transmitted_;  ///< of all
};

}  // namespace tera
