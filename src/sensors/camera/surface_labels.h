#pragma once

#include <cstdint>
#include <optional>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "sensors/camera/flow.h"
#include "sensors/camera/ground_history.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Label images computed from the visible surfaces (LabelSource::kSurfaces): flow between images,
/// ground state, distance.
class SurfaceLabels {
 public:
  SurfaceLabels(const CameraIntrinsics& lens, LabelSet labels);

  /// True if there are such labels. Fill must then be called for each image.
  bool any() const { return any_; }
  /// True if an image depends on earlier images.
  bool HasMemory() const { return flows_ || ages_; }

  /// Fills the requested labels of the image of `scene`. `depth_m` is the exact rendered depth.
  void Fill(const SeenScene& scene, const Image<float>& depth_m, const Image<std::uint16_t>& body,
            CameraFrame* frame);

 private:
  bool Has(std::size_t channel) const { return labels_[channel]; }
  void FillFlows(SeenSurfaces now, CameraFrame* frame);
  void FillGround(const SeenSurfaces& now, CameraFrame* frame) const;
  void FillFlight(const SeenSurfaces& now, CameraFrame* frame) const;
  void FillDistance(const SeenSurfaces& now, CameraFrame* frame) const;

  LabelSet labels_;
  bool any_ = false, flows_ = false, ages_ = false;
  std::optional<PixelRays> rays_;
  std::optional<SeenSurfaces> before_;
  GroundHistory ground_;
};

}  // namespace tera
