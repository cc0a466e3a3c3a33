#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/optics/defocus.h"
#include "sensors/camera/optics/flare.h"
#include "sensors/camera/optics/glare.h"
#include "sensors/camera/optics/optics_model.h"
#include "sensors/camera/optics/soiling.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Effects of the lens and its glass on the luminance of the scene.
///
/// Model   In this order: defocus by distance, attenuation by dirt on the glass, scattering in the
///         lens, ghosts of the sun. The light of the sun is its illuminance times the visible share
///         of its disc. A separate small image determines this share. The disc in the main image is
///         far too dark; its pixels are limited to the luminance of the sky and scatter only as
///         such.
/// Omits   Ghosts of lamps, which scatter like other bright image regions. Glass in front of the
///         sun counts as opaque.
class Optics {
 public:
  Optics(const OpticsModel& model, const CameraIntrinsics& camera, double f_number, double pixel_um,
         std::uint64_t seed, const std::string& stream_name);

  /// `depth_m` is exact; `picture` is in cd/m^2.
  void Apply(const SeenScene& scene, const Image<float>& depth_m, Rasterizer* rasterizer,
             Image<float>* picture) const;
  /// Label of soiled glass: PixelOfShare of the transmittance.
  Image<std::uint8_t> SoilingLabel() const;

 private:
  /// Illuminance of the sun on a plane in front of the lens that faces the sun.
  Vec3 SunBeforeLens_lx(const SeenScene& scene, const Vec3& to_sun_C, Rasterizer* rasterizer) const;
  void Scatter(const Vec3& to_sun_C, const Vec3& sun_lx, Image<float>* picture) const;

  OpticsModel model_;
  CameraIntrinsics camera_;
  ThinLens lens_;
  std::optional<DiscKernels> discs_;
  std::optional<PictureGlare> glare_;
  std::optional<Flare> flare_;
  std::optional<Soiling> soiling_;
  std::vector<Vec3> rays_C_;  ///< rays of the pixels; empty without glare
};

/// Maps 0..1 to 0..255.
std::uint8_t PixelOfShare(double share);

}  // namespace tera
