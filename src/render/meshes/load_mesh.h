#pragma once

#include <filesystem>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Loads glTF (tinygltf), OBJ, STL or DAE (assimp). Pictures are shared with meshes loaded before
/// by `textures`. Throws InputError for a file, node or picture that cannot be read.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// The same, but with a node where the file's scene has it, and not in its own frame.
Mesh LoadPlacedMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// As the first, shared with nothing.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node);

/// The name that LoadMesh gives to a node of a file.
std::string MeshName(const std::filesystem::path& file, const std::string& node);

}  // namespace tera
