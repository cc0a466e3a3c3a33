#pragma once

#include "core/types/looks.h"
#include "render/scene.h"

namespace tera {

/// Triangles of a solid, seen from outside anticlockwise, in `paint`. Edges of boxes and cylinders
/// are sharp.
///
/// Model   balls and cylinders by facets whose corners lie on them, 32 around: a cylinder's outline
///         is at most half a percent of its radius inside the true one.
Mesh MakeSolidMesh(const Solid& solid, const Paint& paint);

}  // namespace tera
