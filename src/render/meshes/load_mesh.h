#pragma once

#include <filesystem>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Loads glTF (tinygltf), OBJ, STL or DAE (assimp). Pictures are shared with meshes loaded before
/// by `textures`. Throws InputError for a file, node or picture that cannot be read.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// The same, shared with nothing.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node);

/// The name that LoadMesh gives to a node of a file.
std::string MeshName(const std::filesystem::path& file, const std::string& node);

}  // namespace tera
