#pragma once

#include <filesystem>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Loads a node of a glTF (tinygltf), OBJ, STL or DAE file (assimp), in the node's own frame. An
/// empty `node` loads the whole scene. Meshes share images through `textures`. Throws InputError if
/// the file, node or an image cannot be read.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// Like LoadMesh, but keeps the node's pose in the file's scene.
Mesh LoadPlacedMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// Like LoadMesh, without shared textures.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node);

/// Name of the mesh that LoadMesh returns for this node.
std::string MeshName(const std::filesystem::path& file, const std::string& node);

}  // namespace tera
