#include "physics/description/urdf_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tera {
namespace {

namespace fs = std::filesystem;

Vec3 VectorOf(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// Package and path of a `package://` or `model://` text.
struct InPackage {
  std::string package;
  fs::path path;
};

std::optional<InPackage> PackageIn(const std::string& text) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (!text.starts_with(scheme)) continue;
    const fs::path whole = text.substr(scheme.size());
    if (whole.empty()) return std::nullopt;
    return InPackage{whole.begin()->string(), whole.lexically_relative(*whole.begin())};
  }
  return std::nullopt;
}

std::optional<fs::path> FindMesh(const std::string& text, const UrdfMeshes& meshes) {
  constexpr std::string_view kFile = "file://";
  const fs::path folder = meshes.urdf.parent_path();
  if (text.starts_with(kFile)) return fs::path(text.substr(kFile.size()));
  const std::optional<InPackage> in = PackageIn(text);
  if (!in) return folder / text;
  if (const auto package = meshes.packages.find(in->package); package != meshes.packages.end()) {
    return package->second / in->path;
  }
  for (fs::path up = fs::absolute(meshes.urdf).parent_path(); up.has_relative_path();
       up = up.parent_path()) {
    for (const fs::path& tail : {in->package / in->path, in->path}) {
      if (fs::is_regular_file(up / tail)) return up / tail;
    }
  }
  return std::nullopt;
}

std::string RemedyOf(const std::string& text) {
  const std::optional<InPackage> in = PackageIn(text);
  return (in ? fmt::format("say where its package is with `packages: {{{}: FOLDER}}` beside `urdf`",
                           in->package)
             : std::string("correct the path (relative to the URDF)")) +
         ", or leave out what is missing with --without-meshes";
}

/// File named by `mesh`. Empty for an omitted mesh or after a fault. `part` is "visual" or
/// "collision".
std::optional<fs::path> MeshFile(const urdf::Mesh& mesh, const PartPlace& place,
                                 std::string_view part, UrdfMeshes* meshes) {
  const auto path = FindMesh(mesh.filename, *meshes);
  std::error_code unreadable;
  if (path && fs::is_regular_file(*path, unreadable)) {
    place.config.AlsoReads(path->lexically_normal());
    return path->lexically_normal();
  }
  std::vector<std::string>& left_out = meshes->left_out;
  if (meshes->absent == AbsentMeshes::kFault) {
    place.Fault(part,
                {FaultKind::kUnreadable, fmt::format("mesh '{}' does not exist; {}", mesh.filename,
                                                     RemedyOf(mesh.filename))});
  } else if (std::find(left_out.begin(), left_out.end(), mesh.filename) == left_out.end()) {
    left_out.push_back(mesh.filename);
  }
  return std::nullopt;
}

/// A box, sphere or cylinder with its size; empty after a fault.
std::optional<Solid> SolidOf(const urdf::Geometry& geometry, const PartPlace& place,
                             std::string_view part) {
  Solid solid;
  if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
    solid = {SolidForm::kBox, VectorOf(box->dim)};
  } else if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) {
    solid = {SolidForm::kSphere, Vec3::Constant(2 * sphere->radius)};
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
    const double width_m = 2 * cylinder->radius;
    solid = {SolidForm::kCylinder, Vec3(width_m, width_m, cylinder->length)};
  }
  if (solid.size_m.allFinite() && solid.size_m.minCoeff() > 0) return solid;
  place.Fault(part, {FaultKind::kOutOfRange,
                     fmt::format("a solid of {} x {} x {} m; need sizes above 0", solid.size_m.x(),
                                 solid.size_m.y(), solid.size_m.z())});
  return std::nullopt;
}

/// Colour of a visual. Empty without a colour, or with only a texture.
std::optional<Paint> PaintOf(const urdf::Visual& visual) {
  if (!visual.material) return std::nullopt;
  const urdf::Color& c = visual.material->color;
  const Vec3 rgb(c.r, c.g, c.b);
  if (!visual.material->texture_filename.empty() && rgb.isZero()) return std::nullopt;
  return PaintFromSrgb(rgb, c.a);
}

void AddVisual(const urdf::Visual& in, const PartPlace& place, UrdfMeshes* meshes, Link* link) {
  Visual visual{.place = place.config.Place("urdf") + ": " + place.part,
                .X_BG = PoseOf(in.origin),
                .paint = PaintOf(in)};
  if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(in.geometry.get())) {
    const auto path = MeshFile(*mesh, place, "visual", meshes);
    if (!path) return;
    const Vec3 scale = VectorOf(mesh->scale), size = scale.cwiseAbs();
    if (size.x() != size.y() || size.x() != size.z() || !(size.x() > 0)) {
      place.Fault("visual", fmt::format("mesh '{}' is scaled by {} {} {}; need one factor, which "
                                        "may be negative along axes that are mirrored",
                                        mesh->filename, scale.x(), scale.y(), scale.z()));
      return;
    }
    visual.mesh = *path;
    visual.scale = scale.prod() > 0 ? size.x() : -size.x();
    visual.X_BG.linear() *= (scale / visual.scale).asDiagonal();  // half a turn or identity
  } else {
    visual.solid = SolidOf(*in.geometry, place, "visual");
    if (!visual.solid) return;
  }
  link->visuals.push_back(std::move(visual));
}

void AddCollision(const urdf::Collision& in, const PartPlace& place, UrdfMeshes* meshes,
                  Link* link) {
  const Pose X_BG = PoseOf(in.origin);
  if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(in.geometry.get())) {
    const auto path = MeshFile(*mesh, place, "collision", meshes);
    if (!path) return;
    link->collision_meshes.push_back({*path, place.part, X_BG, VectorOf(mesh->scale)});
  } else if (const auto solid = SolidOf(*in.geometry, place, "collision")) {
    link->collision.push_back({X_BG, solid->size_m});
  }
}

}  // namespace

Pose PoseOf(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return MakePose(VectorOf(pose.position),
                  Quat(q.w, q.x, q.y, q.z).normalized().toRotationMatrix());
}

void AddUrdfShapes(const urdf::Link& in, const PartPlace& place, UrdfMeshes* meshes, Link* link) {
  for (const auto& visual : in.visual_array) AddVisual(*visual, place, meshes, link);
  for (const auto& collision : in.collision_array) AddCollision(*collision, place, meshes, link);
}

}  // namespace tera
