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

/// The label pictures that are computed from what each pixel shows (LabelSource::kSurfaces): motion
/// from picture to picture, the state of the ground, distance.
class SurfaceLabels {
 public:
  SurfaceLabels(const CameraIntrinsics& lens, LabelSet labels);

  /// Whether any of the labels is of this kind, so that Fill is to be called for each picture.
  bool any() const { return any_; }
  /// Whether a picture follows from those before.
  bool HasMemory() const { return flows_ || ages_; }

  /// Fills what the labels name, for the picture of `scene` with its exact depth, as it was
  /// rendered, and its bodies.
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
