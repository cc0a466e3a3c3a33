#include "render/meshes/painted_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/spelling.h"
#include "render/meshes/load_mesh.h"
#include "render/meshes/solid_mesh.h"

namespace tera {
namespace {

bool HasColours(const std::filesystem::path& file) {
  return LowerCase(file.extension().string()) != ".stl";
}

std::string_view NameOf(SolidForm form) {
  switch (form) {
    case SolidForm::kBox:
      return "box";
    case SolidForm::kSphere:
      return "sphere";
    case SolidForm::kCylinder:
      return "cylinder";
  }
  return "";
}

std::string Shown(const Paint& paint) {
  return fmt::format("({} {} {} {})", paint.albedo.x(), paint.albedo.y(), paint.albedo.z(),
                     paint.opacity);
}

/// Index of the mesh `name`; `make` creates it if it is absent.
template <typename Make>
int IndexOf(const std::string& name, const Make& make, SceneModel* scene) {
  std::vector<Mesh>& meshes = scene->meshes;
  const auto same = std::find_if(meshes.begin(), meshes.end(),
                                 [&](const Mesh& mesh) { return mesh.name == name; });
  if (same != meshes.end()) return static_cast<int>(same - meshes.begin());
  meshes.push_back(make());
  meshes.back().name = name;
  return static_cast<int>(meshes.size()) - 1;
}

}  // namespace

int AddSolid(const Solid& solid, const Paint& paint, SceneModel* scene) {
  const std::string name = fmt::format("{} {} {} {} {}", NameOf(solid.form), solid.size_m.x(),
                                       solid.size_m.y(), solid.size_m.z(), Shown(paint));
  return IndexOf(
      name, [&] { return MakeSolidMesh(solid, paint); }, scene);
}

int AddPaintedMesh(const std::filesystem::path& file, const Paint& paint, SceneModel* scene) {
  if (HasColours(file)) return scene->AddMesh(file, "");
  const auto painted = [&] {
    Mesh mesh = LoadMesh(file, "");
    for (MeshPart& part : mesh.parts) {
      part.material.albedo = paint.albedo;
      part.material.opacity = paint.opacity;
    }
    return mesh;
  };
  return IndexOf(file.string() + " " + Shown(paint), painted, scene);
}

}  // namespace tera
