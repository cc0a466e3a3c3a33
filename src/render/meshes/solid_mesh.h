#pragma once

#include "core/types/looks.h"
#include "render/scene.h"

namespace tera {

/// Triangles of a solid in `paint`, counter-clockwise from outside. Edges of boxes and cylinders
/// are sharp.
///
/// Model   facets of spheres and cylinders have their corners on the surface, 32 around. The
///         outline of a cylinder deviates inwards by at most half a percent of its radius.
Mesh MakeSolidMesh(const Solid& solid, const Paint& paint);

}  // namespace tera
