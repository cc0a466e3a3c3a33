#pragma once

#include <filesystem>

#include "core/types/looks.h"
#include "render/scene.h"

/// Scene parts whose colour is given apart from their shape, as in a URDF.

namespace tera {

/// Adds a solid and returns the index of its mesh. Solids of equal shape and colour share a mesh.
int AddSolid(const Solid& solid, const Paint& paint, SceneModel* scene);

/// Adds a mesh file and returns the index of its mesh. Equal files with equal colour share a mesh.
/// `paint` applies to STL files; other formats have their own colours. Throws like LoadMesh.
int AddPaintedMesh(const std::filesystem::path& file, const Paint& paint, SceneModel* scene);

}  // namespace tera
