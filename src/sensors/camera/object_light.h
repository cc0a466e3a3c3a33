#pragma once

#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"
#include "sensors/camera/sweep.h"

namespace tera {

/// What a picture shows, as far as the light of its objects goes: all on one pixel grid, of the
/// instant of its stamp.
struct LitPicture {
  const SceneModel& model;
  const Image<float>& depth_m;               ///< exact
  const Image<std::uint16_t>& body;          ///< body_picture.h
  const Image<float>& luminance_cdpm2;       ///< as it is before the lens
  const Image<float>& illuminance_lx_share;  ///< Rasterizer::Render's `light`
};

/// Gives each of the frame's boxes its light.
///
/// Model   Means over the object's visible pixels, of a whole over its parts'. The blur of a pixel
///         is how far the point that it shows moves on the picture from `open_s` / 2 before the
///         stamp to as long after it: of a point that passes at v across the axis v open_s f / z.
///         Luminance and illuminance are those of Rec. 709's weights.
/// Omits   of a rolling shutter the rows' own times: the motion is that about the stamp.
///         Points that leave the lens's field have no blur. Glass shows its own body and luminance,
///         and the illuminance of what lies behind it.
void FillObjectLight(const PixelRays& rays, const LitPicture& picture, const SceneAt& scene_at,
                     TimeNs t_ns, double open_s, CameraFrame* frame);

}  // namespace tera
