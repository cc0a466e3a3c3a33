#pragma once

#include <vector>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"

namespace tera {

/// A projector of dots between the eyes of a stereo camera.
///
/// Model   dots at random places in cells of a grid over the tangents of directions, each with the
///         same intensity, round and soft: a standard deviation of `dot_share` of a cell. A surface
///         adds to its luminance what it gives back of the scene's own light, times the dots'
///         illuminance over the scene's, where the projector sees it.
/// Omits   speckle of the laser; the cosine of the dots' incidence beside that of the scene's.
struct DotProjector {
  double intensity_cd = 0;  ///< of a dot in its middle, as visible light
  double cell_deg = 0.5;    ///< side of a cell
  double dot_share = 0.18;
};

void Serialize(ModelArchive* archive, DotProjector* model);

/// Where a projector's dots are.
///
/// Frames  P at the middle of the baseline, axes of C.
class DotPattern {
 public:
  DotPattern(const DotProjector& projector, const Stream& draw);

  /// Intensity over that of a dot's middle, in the direction (x, y, 1); nothing beyond kWidest.
  double At(const Vec2& tangent) const;

  static constexpr double kWidest = 1.5;  ///< tangent

 private:
  double cell_, share_;
  int side_;                ///< cells either way
  std::vector<Vec2> dots_;  ///< of each cell, in cells
};

/// The luminance that a light meter on the scene's ground would make the brightest.
double MeteredWhite_cdpm2(const Rasterizer& rasterizer);

/// One eye that looks at a scene lit by a projector.
struct LitEye {
  const CameraIntrinsics& camera;
  const Pose& X_PE;               ///< of its optical frame
  const Image<float>& depth_m;    ///< as the eye sees it
  const Image<float>& lux_share;  ///< Rasterizer::Render's `light`, likewise
  const Image<float>& from_P_m;   ///< depth as the projector sees it, through the same intrinsics
};

/// Adds the dots to the eye's luminance, one channel.
void AddDots(const DotProjector& projector, const DotPattern& pattern, const LitEye& eye,
             Image<float>* luminance_cdpm2);

}  // namespace tera
