#pragma once

#include <filesystem>

#include "core/types/looks.h"
#include "render/scene.h"

/// Parts of a scene whose colour stands beside their form, as in a URDF.

namespace tera {

/// Adds a solid; the same in the same colour is there once. Returns its mesh's index.
int AddSolid(const Solid& solid, const Paint& paint, SceneModel* scene);

/// Adds a whole mesh file; the same in the same colour is loaded once. `paint` is for STL files;
/// others have colours of their own. Returns its index. Throws as LoadMesh does.
int AddPaintedMesh(const std::filesystem::path& file, const Paint& paint, SceneModel* scene);

}  // namespace tera
