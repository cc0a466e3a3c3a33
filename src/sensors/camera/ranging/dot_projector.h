#pragma once

#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"

namespace tera {

/// A dot projector between the eyes of a stereo camera.
///
/// Model   Dots at random positions in the cells of a grid over direction tangents. All dots have
///         the same intensity and a Gaussian profile, with a standard deviation of `dot_share` of a
///         cell. A surface visible to the projector becomes brighter by the factor 1 + E_dots /
///         E_scene, the ratio of both illuminances.
/// Omits   Laser speckle; the cosine of the dots' incidence relative to that of the scene's light.
struct DotProjector {
  double intensity_cd = 0;  ///< peak intensity of a dot, as visible light
  double cell_deg = 0.5;    ///< side of a cell
  double dot_share = 0.18;
};

void Serialize(ModelArchive* archive, DotProjector* model);

/// Directions of the dots of a projector.
///
/// Frames  P at the middle of the baseline, axes of C.
class DotPattern {
 public:
  DotPattern(const DotProjector& projector, const Stream& draw);

  /// Intensity in the direction (x, y, 1), divided by the peak intensity of a dot; zero beyond
  /// kWidest.
  double At(const Vec2& tangent) const;

  static constexpr double kWidest = 1.5;  ///< greatest tangent of a direction

 private:
  double cell_, share_;
  int side_;                ///< number of cells per axis
  std::vector<Vec2> dots_;  ///< one per cell, in units of cells
};

/// Luminance of the brightest pixel at the exposure of a light meter on the scene.
double MeteredWhite_cdpm2(const Rasterizer& rasterizer);

/// An eye with its view of a scene lit by the projector.
struct LitEye {
  const CameraIntrinsics& camera;
  const Pose& X_PE;               ///< pose of its optical frame
  const Image<float>& depth_m;    ///< depth in the eye's image
  const Image<float>& lux_share;  ///< Rasterizer::Render's `light` in the eye's image
  const Image<float>& from_P_m;   ///< depth in the view of the projector, with the same intrinsics
};

/// Adds the dots to the one-channel luminance of an eye.
void AddDots(const DotProjector& projector, const DotPattern& pattern, const LitEye& eye,
             Image<float>* luminance_cdpm2);

}  // namespace tera
