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

/// Stereo matching of a depth camera.
struct StereoModel {
  int disparities_px = 96;                ///< search range from 0; a multiple of 16
  int block_px = 5;                       ///< side of the matching window; odd
  int uniqueness_percent = 8;             ///< margin of the best match over the second best
  double noise_dn = 1;                    ///< 1 sigma of each eye's grey level in 0..255
  std::optional<DotProjector> projector;  ///< none: passive
};

void Serialize(ModelArchive* archive, StereoModel* model);

/// Depth by stereo matching of two eyes.
///
/// Frames  left eye at the camera's C, the frame of the depth; right eye at x = baseline in C. Both
///         eyes have the camera's intrinsics, without distortion.
/// Model   each eye is rendered under scene light and dot projector, with noise and 8 bits. In
///         sufficient light, the exposure sets the left eye's mean to kMean of its range. OpenCV's
///         semi-global block matching finds disparities in steps of 1/16 px, with left-right check
///         and speckle filter. Depth is f b / disparity. Depth is 0 without a match: surfaces
///         visible to one eye, untextured, repetitive, or nearer than f b / disparities. It is also
///         0 at the left rim of the image, which the search range leaves.
/// Omits   infrared reflectances, which equal the visible reflectances; blur, distortion and
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
