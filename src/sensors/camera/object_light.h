#pragma once

#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Inputs of the objects' light labels: images on one pixel grid, at the time stamp.
struct LitPicture {
  const SceneModel& model;
  const Image<float>& depth_m;               ///< exact
  const Image<std::uint16_t>& body;          ///< body_picture.h
  const Image<float>& luminance_cdpm2;       ///< in front of the lens
  const Image<float>& illuminance_lx_share;  ///< Rasterizer::Render's `light`
};

/// Sets the light of each box of the frame.
///
/// Model   means over the object's visible pixels; a whole uses its parts' pixels. The blur of a
///         pixel is the image motion of its point within `open_s` / 2 of the stamp. A point that
///         passes at v across the axis has the blur v open_s f / z. Luminance and illuminance use
///         Rec. 709 weights.
/// Omits   row times of a rolling shutter: the motion is centred at the stamp. Points that leave
///         the lens's field have no blur. Glass shows its own body and luminance, and the
///         illuminance of the surface behind it.
void FillObjectLight(const PixelRays& rays, const LitPicture& picture, const SceneAt& scene_at,
                     TimeNs t_ns, double open_s, CameraFrame* frame);

}  // namespace tera
