#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/config/model_archive.h"
#include "core/random.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/ranging/dot_projector.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// How a stereo camera finds its depth.
struct StereoModel {
  int disparities_px = 96;                ///< range that is searched, from 0; a multiple of 16
  int block_px = 5;                       ///< side of the window that is compared; odd
  int uniqueness_percent = 8;             ///< by which the best match must beat the second best
  double noise_dn = 1;                    ///< 1 sigma of a grey level of 0..255 of each eye
  std::optional<DotProjector> projector;  ///< none: passive
};

void Serialize(ModelArchive* archive, StereoModel* model);

/// Depth of two eyes, matched.
///
/// Frames  left eye at the camera's C, which the depth is of, right eye at x = baseline in C, both
///         with the camera's intrinsics, which have no distortion.
/// Model   Each eye is rendered, lit by scene and dot projector, exposed so that the mean of
///         the left one is kMean of its range, where there is light enough, with noise and 8 bits.
///         Disparities are those of OpenCV's semi-global block matching with a check from left to
///         right and speckles left out, in steps of 1/16 px; depth is f b / disparity. 0 where
///         nothing matches: surfaces that one eye alone sees, without texture, repeated, or nearer
///         than f b / disparities; and the left rim of the picture, where the range does not fit
///         in.
/// Omits   infrared reflectances, which are those of visible light; blur and distortion of the
///         eyes, their misalignment; filters that smooth depth and fill holes.
/// Source  Hirschmueller 2008, "Stereo processing by semiglobal matching and mutual information";
///         OpenCV 4.6, StereoSGBM.
class Stereo {
 public:
  Stereo(const StereoModel& model, const CameraIntrinsics& camera, double baseline_m,
         std::uint64_t seed, const std::string& stream_name);

  /// Depth of picture k.
  Image<float> Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;
  /// What an eye sees: 8-bit grey of both, left and right.
  struct Eyes {
    Image<std::uint8_t> left, right;
  };
  Eyes Look(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;
  Image<float> Match(const Eyes& eyes) const;

  static constexpr double kMean = 0.3;

 private:
  StereoModel model_;
  CameraIntrinsics camera_;
  double baseline_m_;
  Stream noise_;
  std::optional<DotPattern> dots_;
};

}  // namespace tera
