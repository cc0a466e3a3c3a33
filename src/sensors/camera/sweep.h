#pragma once

#include <functional>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/shutter.h"

namespace tera {

/// Scene and pose of a camera.
struct SeenScene {
  Pose X_WC;
  SceneState state;
};

/// The scene at time `t_ns`, near the time of an image.
using SceneAt = std::function<SeenScene(TimeNs t_ns)>;

/// Parameters of an image whose rows have separate exposures.
struct SweptView {
  const ShutterModel& shutter;
  double exposure_s;
  const CameraIntrinsics& lens;
  LabelSet labels;
  const SceneAt& scene_at;
};

/// Renders the image with time stamp `t_ns`, in luminance, with depth and labels.
///
/// Model   Light is the mean of luminance over the instants of Exposures. Depth and labels of a row
///         show the instant at the middle of its exposure; 3-D boxes refer to `t_ns`. The image
///         motion (ImageMotion_px) determines the number of instants.
/// Omits   Motion of the ground, and of soil in a shovel, within the image: all instants use one
///         state.
///
/// `body` and `light`, if given, receive these images of Rasterizer::Render at `t_ns`.
CameraFrame Sweep(const SweptView& view, TimeNs t_ns, Rasterizer* rasterizer,
                  LuminancePicture* luminance, Image<std::uint16_t>* body = nullptr,
                  Image<float>* light = nullptr);

}  // namespace tera
