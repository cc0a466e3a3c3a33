#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"

namespace tera {

/// Exact surfaces in an image, with the poses of camera and bodies.
struct SeenSurfaces {
  Pose X_WC = Pose::Identity();
  std::vector<Pose> X_WB;
  Image<float> depth_m;       ///< CameraIntrinsics::DepthOf; 0 for infinity
  Image<std::uint16_t> body;  ///< bodies, see body_picture.h
};

/// Optical flow from the pixels of `from` to `to`, encoded as in image_flow.h, and scene flow: the
/// displacement of each point in C. Either output may be null.
///
/// Model   The point at the centre of a pixel moves with its body. Ground and land are static;
///         points without depth are infinitely far. `to` shows the point if one of the four pixels
///         around it has the same body, and is at most 1 % nearer. Otherwise the point is occluded.
/// Omits   Moving soil: the flow of airborne clods is unknown, and ground dug between the images
///         counts as static.
void FlowBetween(const PixelRays& rays, const SeenSurfaces& from, const SeenSurfaces& to,
                 Image<std::uint16_t>* flow, Image<std::uint16_t>* scene_flow);

}  // namespace tera
