#include "sim/scenario/site_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/error.h"
#include "render/meshes/load_mesh.h"
#include "render/meshes/top_of_mesh.h"

namespace tera {
namespace {

constexpr double kDefaultCell_m = 0.1, kLeastCell_m = 0.02, kLargestCell_m = 5;
constexpr double kMostVertices = 2.5e7;
constexpr double kLargestScale = 1e4;

using Placement = Eigen::Affine3d;

/// Transforms a mesh from the file's axes to W.
void Place(const Placement& X_WG, Mesh* mesh) {
  const Eigen::Affine3f X = X_WG.cast<float>();
  const Eigen::Matrix3f turn = X.linear() / std::cbrt(X.linear().determinant());
  for (MeshPart& part : mesh->parts) {
    for (Eigen::Vector3f& p : part.positions_m) p = X * p;
    for (Eigen::Vector3f& n : part.normals) n = turn * n;
  }
}

/// Loads a node of the file, in W; the whole file if no node is named. Returns nothing after a
/// fault at `key`.
std::optional<Mesh> Load(const ConfigMap& config, std::string_view key,
                         const std::filesystem::path& file, const std::string& node,
                         const Placement& X_WG, SiteMesh* site) {
  try {
    Mesh mesh = LoadPlacedMesh(file, node, &site->textures);
    for (const std::filesystem::path& read : mesh.files) config.AlsoReads(read);
    Place(X_WG, &mesh);
    return mesh;
  } catch (const InputError& e) {
    config.Fault(key, e.faults().front());
    return std::nullopt;
  }
}

SemanticClass LabelAt(const ConfigMap& config) {
  const std::string label = config.Text("label", "structure");
  if (const auto known = SemanticClassFromName(label)) return *known;
  std::vector<std::string> names;
  for (const SemanticClassInfo& info : kSemanticClasses) names.emplace_back(info.name);
  config.Fault("label", {FaultKind::kNoSuchName,
                         "'" + label + "' is not a semantic class" + DidYouMean(label, names)});
  return SemanticClass::kStructure;
}

/// Extent of a mesh in x and y.
struct Extent {
  Vec2 low_m = Vec2::Constant(std::numeric_limits<double>::infinity()), high_m = -low_m;
};

Extent ExtentOf(const Mesh& mesh) {
  Extent extent;
  for (const MeshPart& part : mesh.parts) {
    for (const Eigen::Vector3f& p : part.positions_m) {
      extent.low_m = extent.low_m.cwiseMin(p.head<2>().cast<double>());
      extent.high_m = extent.high_m.cwiseMax(p.head<2>().cast<double>());
    }
  }
  return extent;
}

/// Number of vertices along `size_m`. It is odd, so that the origin of W is a vertex.
int VerticesOver(double size_m, double cell_m) {
  return 2 * static_cast<int>(std::floor(0.5 * size_m / cell_m + 1e-9)) + 1;
}

/// Size of the terrain if given. Otherwise the largest rectangle that is centred on the origin of W
/// and covered by the mesh.
Vec2 SiteSize_m(const ConfigMap& terrain, const Extent& extent) {
  if (terrain.Has("size_m")) return terrain.Vector2("size_m", Positive("m"));
  return 2 * extent.high_m.cwiseMin(-extent.low_m);
}

/// Sets the ground from the upper surface of a mesh. Parts of the site without mesh are a fault.
void SetGround(const ConfigMap& config, const ConfigMap& terrain, const Mesh& mesh,
               SiteMesh* site) {
  const double cell_m =
      config.Number("cell_m", Between(kLeastCell_m, kLargestCell_m, "m"), kDefaultCell_m);
  const Extent extent = ExtentOf(mesh);
  const Vec2 size_m = SiteSize_m(terrain, extent);
  if (size_m.minCoeff() < 2 * cell_m) {
    config.Fault(
        "", fmt::format("reaches from x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m, not "
                        "around W's origin; move the mesh by its xyz_m",
                        extent.low_m.x(), extent.high_m.x(), extent.low_m.y(), extent.high_m.y()));
    return;
  }
  const Vec2 vertices = (size_m / cell_m).array() + 1;
  if (!(vertices.prod() <= kMostVertices)) {
    config.Fault("cell_m", {FaultKind::kOutOfRange,
                            fmt::format("{:.0f} x {:.0f} heights are more than {}; need a larger "
                                        "cell_m or a smaller terrain.size_m",
                                        vertices.x(), vertices.y(), kMostVertices)});
    return;
  }
  const int nx = VerticesOver(size_m.x(), cell_m), ny = VerticesOver(size_m.y(), cell_m);
  const Vec2 low_m = -0.5 * cell_m * Vec2(nx - 1, ny - 1);
  TopOfMesh top = TopOf(mesh, low_m, cell_m, nx, ny);
  const auto is_gap = [](float z_m) { return std::isnan(z_m); };
  const auto gap = std::find_if(top.height_m.begin(), top.height_m.end(), is_gap);
  if (gap != top.height_m.end()) {
    const auto at = static_cast<int>(gap - top.height_m.begin());
    config.Fault(
        "", fmt::format("{} of {} heights of the site have no mesh below, the first at ({:.2f}, "
                        "{:.2f}) m; close the gaps, or choose a smaller terrain.size_m",
                        std::count_if(gap, top.height_m.end(), is_gap), top.height_m.size(),
                        low_m.x() + cell_m * (at % nx), low_m.y() + cell_m * (at / nx)));
    return;
  }
  site->ground = GivenGround{nx, ny, cell_m, {top.height_m.begin(), top.height_m.end()}};
  site->paint = std::make_shared<const GroundPaint>(
      GroundPaint{low_m, cell_m, nx, ny, std::move(top.albedo), std::move(top.height_m)});
}

void ReadParts(const ConfigMap& config, const std::filesystem::path& file, const Placement& X_WG,
               SiteMesh* site) {
  for (const ConfigMap& item : config.List("parts")) {
    SiteMeshPart part;
    const std::string node = item.Text("node");
    part.name = item.Text("name", node);
    RequirePlainName(item, item.Has("name") ? "name" : "node", part.name);
    part.label = LabelAt(item);
    part.is_solid = item.Boolean("solid", true);
    auto mesh = Load(item, "node", file, node, X_WG, site);
    if (!mesh) continue;
    part.mesh = std::move(*mesh);
    site->parts.push_back(std::move(part));
  }
}

}  // namespace

SiteWalls SiteMesh::Walls() const {
  SiteWalls walls;
  for (const SiteMeshPart& site_part : parts) {
    if (!site_part.is_solid) continue;
    for (const MeshPart& part : site_part.mesh.parts) {
      const auto first = static_cast<std::uint32_t>(walls.corners_W_m.size());
      for (const Eigen::Vector3f& p : part.positions_m) {
        walls.corners_W_m.push_back(p.cast<double>());
      }
      for (const std::uint32_t i : part.indices) walls.indices.push_back(first + i);
    }
  }
  return walls;
}

std::shared_ptr<const SiteMesh> ReadSiteMesh(const ConfigMap& config, const ConfigMap& terrain) {
  const std::filesystem::path file = config.File("file");
  Placement X_WG = Placement(config.PoseXyzRpy());
  X_WG.scale(config.Number("scale", {.min = 0, .max = kLargestScale, .min_excluded = true}, 1.0));
  auto site = std::make_shared<SiteMesh>();
  if (file.empty()) {
    for (const char* key : {"parts", "ground"}) config.Has(key);
    return nullptr;
  }
  const bool is_whole = !config.Has("parts") && !config.Has("ground");
  if (config.Has("parts")) ReadParts(config, file, X_WG, site.get());
  const auto ground = config.OptionalMap("ground");
  if (ground) {
    if (const auto mesh = Load(*ground, "node", file, ground->Text("node", ""), X_WG, site.get())) {
      SetGround(*ground, terrain, *mesh, site.get());
    }
  }
  if (is_whole) {
    if (auto mesh = Load(config, "file", file, "", X_WG, site.get())) {
      site->parts.push_back({.name = "site", .mesh = std::move(*mesh)});
    }
  }
  return site;
}

}  // namespace tera
