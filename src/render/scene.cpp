#include "render/scene.h"

#include <algorithm>

#include "render/meshes/load_mesh.h"

namespace tera {

int SceneModel::AddMesh(const std::filesystem::path& file, const std::string& node) {
  const std::string name = MeshName(file, node);
  const auto same = std::find_if(meshes.begin(), meshes.end(),
                                 [&](const Mesh& mesh) { return mesh.name == name; });
  if (same != meshes.end()) return static_cast<int>(same - meshes.begin());
  meshes.push_back(LoadMesh(file, node, &textures));
  return static_cast<int>(meshes.size()) - 1;
}

const ShapedMesh* ShapeAt(const Shapes& shapes, int index) {
  return index >= 0 && index < static_cast<int>(shapes.size()) ? shapes[index].get() : nullptr;
}

bool AreAlike(const ShapedMesh* a, const ShapedMesh* b) {
  return a == b || (a != nullptr && b != nullptr && a->key == b->key);
}

}  // namespace tera
