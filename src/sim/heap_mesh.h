#pragma once

#include "core/types/ground_tools.h"
#include "render/scene.h"

namespace tera {

/// Soil that just fills a shovel, heaped over its mouth.
///
/// Frames  positions relative to `bottom_B_m` (the deepest point of the shell), axes of the link,
///         so that scaling the mesh about its origin fills the shovel from the bottom.
/// Model   the profile extruded over the width, closed by a mound of `kHeapShare` of the mouth's
///         length in the middle.
struct HeapMesh {
  Mesh mesh;
  Vec3 bottom_B_m = Vec3::Zero();
};

HeapMesh MakeHeapMesh(const Shovel& shovel, const Vec3& albedo);

}  // namespace tera
