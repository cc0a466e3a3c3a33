#include "render/meshes/top_of_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "render/meshes/picture_file.h"

namespace tera {
namespace {

/// Allowed negative barycentric coordinate, so that no vertical line passes between two triangles.
constexpr double kSlack = 1e-6;

/// A triangle of a part.
struct PlacedTriangle {
  const MeshPart& part;
  const std::uint32_t* corner;

  Vec3 At(int k) const { return part.positions_m[corner[k]].cast<double>(); }

  Eigen::Vector3f AlbedoAt(const Vec3& share) const {
    Vec3 albedo = part.material.albedo;
    if (!part.albedos.empty()) {
      albedo.setZero();
      for (int k = 0; k < 3; ++k) {
        albedo += share[k] * part.albedos[corner[k]].cast<double>();
      }
    }
    if (const auto& picture = part.material.textures.base_colour) {
      Vec2 uv = Vec2::Zero();
      for (int k = 0; k < 3; ++k) uv += share[k] * part.uvs[corner[k]].cast<double>();
      albedo = albedo.cwiseProduct(tera::AlbedoAt(*picture, uv.x(), uv.y()));
    }
    return albedo.cast<float>();
  }
};

/// Writes height and colour at the vertices where this triangle is the highest so far.
void Enter(const PlacedTriangle& triangle, TopOfMesh* top) {
  const Vec3 a = triangle.At(0), b = triangle.At(1), c = triangle.At(2);
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (area == 0) return;  // vertical
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const auto number = [&](double place_m, int axis, int last) {
    const double at = std::round((place_m - top->low_m[axis]) / top->cell_m);
    return static_cast<int>(std::clamp(at, 0.0, last - 1.0));
  };
  for (int j = number(low.y() - top->cell_m, 1, top->ny);
       j <= number(high.y() + top->cell_m, 1, top->ny); ++j) {
    for (int i = number(low.x() - top->cell_m, 0, top->nx);
         i <= number(high.x() + top->cell_m, 0, top->nx); ++i) {
      const Vec2 p = top->low_m + top->cell_m * Vec2(i, j);
      const double to_b =
          ((p.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (p.y() - a.y())) / area;
      const double to_c =
          ((b.x() - a.x()) * (p.y() - a.y()) - (p.x() - a.x()) * (b.y() - a.y())) / area;
      const Vec3 share(1 - to_b - to_c, to_b, to_c);
      if (share.minCoeff() < -kSlack) continue;
      const auto z_m = static_cast<float>(share.dot(Vec3(a.z(), b.z(), c.z())));
      float& highest_m = top->height_m[top->index(i, j)];
      if (highest_m >= z_m) continue;  // false for NaN
      highest_m = z_m;
      top->albedo[top->index(i, j)] = triangle.AlbedoAt(share);
    }
  }
}

}  // namespace

TopOfMesh TopOf(const Mesh& mesh, const Vec2& low_m, double cell_m, int nx, int ny) {
  TERA_CHECK(cell_m > 0 && nx > 0 && ny > 0, cell_m, nx, ny);
  TopOfMesh top{low_m, cell_m, nx, ny, {}, {}};
  const std::size_t count = static_cast<std::size_t>(nx) * ny;
  top.height_m.assign(count, std::numeric_limits<float>::quiet_NaN());
  top.albedo.assign(count, Eigen::Vector3f::Zero());
  for (const MeshPart& part : mesh.parts) {
    for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3) {
      Enter({part, &part.indices[t]}, &top);
    }
  }
  return top;
}

}  // namespace tera
