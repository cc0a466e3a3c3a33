#pragma once

#include "core/types/looks.h"
#include "render/scene.h"

namespace tera {

/// Triangles of a solid with the colour `paint`, counter-clockwise seen from outside. Edges of
/// boxes and cylinders are sharp.
///
/// Model   spheres and cylinders have 32 facets around, with corners on the true surface. The
///         outline of a cylinder lies at most half a percent of the radius inside the true one.
Mesh MakeSolidMesh(const Solid& solid, const Paint& paint);

}  // namespace tera
