#pragma once

#include <cstdint>
#include <vector>

#include "core/motion.h"
#include "core/types/measurement.h"
#include "sensors/camera/pixel_rays.h"

namespace tera {

/// What a picture shows, exactly, and where all of it was.
struct SeenSurfaces {
  Pose X_WC = Pose::Identity();
  std::vector<Pose> X_WB;
  Image<float> depth_m;       ///< CameraIntrinsics::DepthOf; 0: infinitely far
  Image<std::uint16_t> body;  ///< body_picture.h
};

/// The flow from the pixels of `from` to `to`, as image_flow.h encodes it, and of each point how
/// far it moves in C on the way; either may be null.
///
/// Model   the point that a pixel's middle shows moves with its body; ground and land stand still,
///         and what has no depth is infinitely far. `to` shows the point where one of the four
///         pixels about its place shows the same body no nearer than 1 % before it; else it is
///         hidden there.
/// Omits   soil that slides or flies: of clods in the air nothing is known, ground that is dug
///         between the pictures is taken to stand still.
void FlowBetween(const PixelRays& rays, const SeenSurfaces& from, const SeenSurfaces& to,
                 Image<std::uint16_t>* flow, Image<std::uint16_t>* scene_flow);

}  // namespace tera
