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

/// What a camera's lens and glass do to the luminance of a scene.
///
/// Model   In this order: the scene is blurred by distance, dirt on the glass takes its share, the
///         lens scatters, and ghosts of the sun come on top. The sun counts by its illuminance and
///         by the share of its disc that the eye sees past all things, drawn as a small picture of
///         its own; in the picture itself its disc is far too dark, and scatters nothing.
/// Omits   ghosts of lamps, which scatter as bright parts of the picture. Glass counts as opaque
///         before the sun.
class Optics {
 public:
  Optics(const OpticsModel& model, const CameraIntrinsics& camera, double f_number, double pixel_um,
         std::uint64_t seed, const std::string& stream_name);

  /// `depth_m` is exact, `picture` in cd/m^2.
  void Apply(const SeenScene& scene, const Image<float>& depth_m, Rasterizer* rasterizer,
             Image<float>* picture) const;
  /// The label picture of soiled glass, PixelOfShare of what comes through.
  Image<std::uint8_t> SoilingLabel() const;

 private:
  /// Of the sun on a plane before the lens that faces it.
  Vec3 SunBeforeLens_lx(const SeenScene& scene, const Vec3& to_sun_C, Rasterizer* rasterizer) const;
  void Scatter(const Vec3& to_sun_C, const Vec3& sun_lx, Image<float>* picture) const;

  OpticsModel model_;
  CameraIntrinsics camera_;
  ThinLens lens_;
  std::optional<DiscKernels> discs_;
  std::optional<PictureGlare> glare_;
  std::optional<Flare> flare_;
  std::optional<Soiling> soiling_;
  std::vector<Vec3> rays_C_;  ///< of the pixels, where the sun may scatter
};

/// 0 to 255 for 0 to 1.
std::uint8_t PixelOfShare(double share);

}  // namespace tera
