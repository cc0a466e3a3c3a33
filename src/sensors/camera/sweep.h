#pragma once

#include <functional>

#include "core/types/label_channels.h"
#include "core/types/measurement.h"
#include "render/gl/rasterizer.h"
#include "sensors/camera/shutter.h"

namespace tera {

/// What a camera looks at, and from where.
struct SeenScene {
  Pose X_WC;
  SceneState state;
};

/// The same at the time `t_ns`, near a picture's.
using SceneAt = std::function<SeenScene(TimeNs t_ns)>;

/// A picture whose rows are exposed for a while, each at its time.
struct SweptView {
  const ShutterModel& shutter;
  double exposure_s;
  const CameraIntrinsics& lens;
  LabelSet labels;
  const SceneAt& scene_at;
};

/// The picture stamped `t_ns`, in luminance, with depth and labels.
///
/// Model   light as Exposures has it, averaged as luminance. Depth and labels of a row are those
///         of the instant in the middle of its exposure; 3-D boxes are as they stand at `t_ns`.
///         As many instants as the motion on the picture asks for (ImageMotion_px).
/// Omits   motion of the ground, and of soil in a shovel, within the picture: one stands for all.
///
/// `body` and `light`, if asked for, become those pictures of Rasterizer::Render at `t_ns`.
CameraFrame Sweep(const SweptView& view, TimeNs t_ns, Rasterizer* rasterizer,
                  LuminancePicture* luminance, Image<std::uint16_t>* body = nullptr,
                  Image<float>* light = nullptr);

}  // namespace tera
