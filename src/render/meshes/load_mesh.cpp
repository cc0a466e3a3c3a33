#include "render/meshes/load_mesh.h"

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
  throw InputError(file.string(), {FaultKind::kUnreadable,
                                   "no such mesh file; need a glTF, OBJ, STL or DAE file"});
}

Mesh Load(const std::filesystem::path& file, const std::string& node, Textures* textures,
          NodeFrame frame) {
  RequireFile(file);
  Mesh mesh = IsGltf(file) ? LoadGltf(file, node, textures, frame)
                           : LoadWithAssimp(file, node, textures, frame);
  mesh.name = MeshName(file, node);
  return mesh;
}

}  // namespace

std::string MeshName(const std::filesystem::path& file, const std::string& node) {
  return node.empty() ? file.string() : file.string() + "#" + node;
}

Mesh LoadMesh(const std::filesystem::path& file, const std::string& node, Textures* textures) {
  return Load(file, node, textures, NodeFrame::kOwn);
}

Mesh LoadPlacedMesh(const std::filesystem::path& file, const std::string& node,
                    Textures* textures) {
  return Load(file, node, textures, NodeFrame::kScene);
}

Mesh LoadMesh(const std::filesystem::path& file, const std::string& node) {
  Textures own;
  return LoadMesh(file, node, &own);
}

}  // namespace tera
