#pragma once

#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"

namespace tera {

/// A dot projector between the eyes of a stereo camera.
///
/// Model   dots at random positions in cells of a grid over direction tangents. All dots have the
///         same intensity and a Gaussian profile, with a standard deviation of `dot_share` of a
///         cell. A surface visible to the projector gains its own luminance times the dots'
///         illuminance over the scene's.
/// Omits   laser speckle; the cosine of the dots' incidence relative to the scene light's.
struct DotProjector {
  double intensity_cd = 0;  ///< peak intensity of a dot, as visible light
  double cell_deg = 0.5;    ///< side of a cell
  double dot_share = 0.18;
};

void Serialize(ModelArchive* archive, DotProjector* model);

/// Directions of a projector's dots.
///
/// Frames  P at the middle of the baseline, axes of C.
class DotPattern {
 public:
  DotPattern(const DotProjector& projector, const Stream& draw);

  /// Intensity relative to a dot's peak, in the direction (x, y, 1); zero beyond kWidest.
  double At(const Vec2& tangent) const;

  static constexpr double kWidest = 1.5;  ///< tangent

 private:
  double cell_, share_;
  int side_;                ///< cells per axis
  std::vector<Vec2> dots_;  ///< one per cell, in cell units
};

/// Luminance of the brightest pixel under a light meter's exposure for the scene's ground.
double MeteredWhite_cdpm2(const Rasterizer& rasterizer);

/// An eye with a view of a scene lit by a projector.
struct LitEye {
  const CameraIntrinsics& camera;
  const Pose& X_PE;               ///< pose of its optical frame
  const Image<float>& depth_m;    ///< depth in the eye's image
  const Image<float>& lux_share;  ///< Rasterizer::Render's `light` in the eye's image
  const Image<float>& from_P_m;   ///< depth in the projector's view, with the same intrinsics
};

/// Adds the dots to the eye's one-channel luminance.
void AddDots(const DotProjector& projector, const DotPattern& pattern, const LitEye& eye,
             Image<float>* luminance_cdpm2);

}  // namespace tera
