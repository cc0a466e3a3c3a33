#include "render/meshes/load_mesh.h"

#include <fmt/format.h>

#include "core/error.h"
#include "render/meshes/mesh_file.h"

namespace tera {
namespace {

bool IsGltf(const std::filesystem::path& file) {
  return file.extension() == ".glb" || file.extension() == ".gltf";
}

void RequireFile(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return;
  throw InputError(
      fmt::format("{}: no such mesh file; need a glTF, OBJ, STL or DAE file", file.string()));
}

}  // namespace

std::string MeshName(const std::filesystem::path& file, const std::string& node) {
  return node.empty() ? file.string() : file.string() + "#" + node;
}

Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures) {
  RequireFile(file);
  Mesh mesh = IsGltf(file) ? LoadGltf(file, node, textures) : LoadWithAssimp(file, node);
  mesh.name = MeshName(file, node);
  return mesh;
}

Mesh LoadMesh(const std::filesystem::path& file, const std::string& node) {
  Textures own;
  return LoadMesh(file, node, &own);
}

}  // namespace tera
