#pragma once

#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// Images from which brightness, illuminance and motion blur of objects are computed. All have one
/// pixel grid and show the instant of the time stamp.
struct LitPicture {
  const SceneModel& model;
  const Image<float>& depth_m;               ///< exact depth
  const Image<std::uint16_t>& body;          ///< bodies, see body_picture.h
  const Image<float>& luminance_cdpm2;       ///< in front of the lens
  const Image<float>& illuminance_lx_share;  ///< Rasterizer::Render's `light`
};

/// Sets the light of each box of the frame.
///
/// Model   Means over the visible pixels of an object. An object with parts includes the pixels of
///         its parts. The blur of a pixel is the image motion of its point within `open_s` / 2 of
///         the stamp. For a point that moves at v across the axis, it is v open_s f / z. Luminance
///         and illuminance use Rec. 709 weights.
/// Omits   Row times of a rolling shutter: the motion is centred at the stamp. Points that leave
///         the field of the lens have no blur. Glass has its own body and luminance, but the
///         illuminance of the surface behind it.
void FillObjectLight(const PixelRays& rays, const LitPicture& picture, const SceneAt& scene_at,
                     TimeNs t_ns, double open_s, CameraFrame* frame);

}  // namespace tera
