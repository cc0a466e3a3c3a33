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

struct StereoModel {
  int disparities_px = 96;                ///< search range from 0; a multiple of 16
  int block_px = 5;                       ///< side of the matching window; odd
  int uniqueness_percent = 8;             ///< margin of the best match to the second best
  double noise_dn = 1;                    ///< 1 sigma of the grey level of each eye, in 0..255
  std::optional<DotProjector> projector;  ///< none for passive stereo
};

void Serialize(ModelArchive* archive, StereoModel* model);

/// Depth by stereo matching of two eyes.
///
/// Frames  The left eye is at the camera's C, the frame of the depth; the right eye is at x =
///         baseline in C. Both eyes have the camera's intrinsics, without distortion.
/// Model   Each eye is rendered under scene light and dot projector, with noise and 8 bits. The
///         exposure sets the mean of the left eye to kMean of its range, if there is enough light.
///         OpenCV's semi-global block matching finds disparities in steps of 1/16 px, with
///         left-right check and speckle filter. Depth is f b / disparity. It is 0 without a match:
///         for surfaces that only one eye sees, without texture, with repetitive texture, or nearer
///         than f b / disparities. It is also 0 at the left rim of the image, which the search
///         range cannot cover.
/// Omits   Infrared reflectances, which are taken as the visible ones; blur, distortion and
///         misalignment of the eyes; filters that smooth depth and fill holes.
/// Source  Hirschmueller 2008, "Stereo processing by semiglobal matching and mutual information";
///         OpenCV 4.6, StereoSGBM.
class Stereo {
 public:
  Stereo(const StereoModel& model, const CameraIntrinsics& camera, double baseline_m,
         std::uint64_t seed, const std::string& stream_name);

  /// Depth of image k.
  Image<float> Measure(std::int64_t k, const SeenScene& scene, Rasterizer* rasterizer) const;
  /// 8-bit grey images of both eyes.
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
