#pragma once

#include <filesystem>
#include <string>

#include "render/meshes/mesh.h"

namespace tera {

/// Loads glTF (tinygltf), OBJ, STL or DAE (assimp), with the node in its own frame. `textures`
/// shares images between meshes. Throws InputError for an unreadable file, node or image.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// Like LoadMesh, but places the node as in the file's scene.
Mesh LoadPlacedMesh(const std::filesystem::path& file, const std::string& node, Textures* textures);
/// Like LoadMesh, without shared textures.
Mesh LoadMesh(const std::filesystem::path& file, const std::string& node);

/// Name that LoadMesh assigns to a node of a file.
std::string MeshName(const std::filesystem::path& file, const std::string& node);

}  // namespace tera
