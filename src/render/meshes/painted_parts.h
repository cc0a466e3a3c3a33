#pragma once

#include <filesystem>

#include "core/types/looks.h"
#include "render/scene.h"

/// Scene parts with a colour separate from their shape, as in a URDF.

namespace tera {

/// Adds a solid and returns its mesh's index. An equal solid of equal colour is added once.
int AddSolid(const Solid& solid, const Paint& paint, SceneModel* scene);

/// Adds a whole mesh file and returns its index. An equal file of equal colour is loaded once.
/// `paint` applies to STL files; other formats have their own colours. Throws like LoadMesh.
int AddPaintedMesh(const std::filesystem::path& file, const Paint& paint, SceneModel* scene);

}  // namespace tera
