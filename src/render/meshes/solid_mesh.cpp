#include "render/meshes/solid_mesh.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr int kAround = 32;
constexpr int kFromPoleToPole = kAround / 2;

std::uint32_t AddVertex(const Vec3& p_m, const Vec3& normal, MeshPart* part) {
  part->positions_m.push_back(p_m.cast<float>());
  part->normals.push_back(normal.cast<float>());
  return static_cast<std::uint32_t>(part->positions_m.size() - 1);
}

void AddTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, MeshPart* part) {
  part->indices.insert(part->indices.end(), {a, b, c});
}

/// The k-th of kAround unit vectors in the horizontal plane.
Vec3 Around(int k) {
  const double angle_rad = 2 * kPi * k / kAround;
  return {std::cos(angle_rad), std::sin(angle_rad), 0};
}

void AddBox(const Vec3& size_m, MeshPart* part) {
  const Vec3 half_m = 0.5 * size_m;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 n = side * Vec3::Unit(axis);
      const Vec3 u = Vec3::Unit((axis + 1) % 3), v = n.cross(u);
      const auto corner = [&](double a, double b) {
        return AddVertex((n + a * u + b * v).cwiseProduct(half_m), n, part);
      };
      const std::uint32_t a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1),
                          d = corner(-1, 1);
      AddTriangle(a, b, c, part);
      AddTriangle(a, c, d, part);
    }
  }
}

void AddSphere(const Vec3& size_m, MeshPart* part) {
  const auto vertex = [](int row, int k) {
    return static_cast<std::uint32_t>(row * (kAround + 1) + k);
  };
  for (int row = 0; row <= kFromPoleToPole; ++row) {
    const double polar_rad = kPi * row / kFromPoleToPole;
    for (int k = 0; k <= kAround; ++k) {
      const Vec3 n = std::sin(polar_rad) * Around(k) + std::cos(polar_rad) * Vec3::UnitZ();
      AddVertex(0.5 * n.cwiseProduct(size_m), n, part);
      if (row == 0 || k == 0) continue;
      const std::uint32_t above = vertex(row - 1, k), below = vertex(row, k);
      if (row > 1) AddTriangle(above - 1, below - 1, above, part);
      if (row < kFromPoleToPole) AddTriangle(above, below - 1, below, part);
    }
  }
}

void AddCylinder(const Vec3& size_m, MeshPart* part) {
  const Vec3 half_m = 0.5 * size_m;
  for (int k = 0; k < kAround; ++k) {
    const Vec3 n0 = Around(k), n1 = Around(k + 1);
    const auto corner = [&](const Vec3& n, double z) {
      return AddVertex((n + z * Vec3::UnitZ()).cwiseProduct(half_m), n, part);
    };
    const std::uint32_t a = corner(n0, -1), b = corner(n1, -1), c = corner(n1, 1),
                        d = corner(n0, 1);
    AddTriangle(a, b, c, part);
    AddTriangle(a, c, d, part);
    for (const double z : {-1.0, 1.0}) {
      const Vec3 up = z * Vec3::UnitZ();
      const auto rim = [&](const Vec3& n) {
        return AddVertex((n + up).cwiseProduct(half_m), up, part);
      };
      const std::uint32_t middle = rim(Vec3::Zero()), first = rim(n0), second = rim(n1);
      AddTriangle(middle, z > 0 ? first : second, z > 0 ? second : first, part);
    }
  }
}

}  // namespace

Mesh MakeSolidMesh(const Solid& solid, const Paint& paint) {
  MeshPart part;
  part.material.albedo = paint.albedo;
  part.material.opacity = paint.opacity;
  switch (solid.form) {
    case SolidForm::kBox:
      AddBox(solid.size_m, &part);
      break;
    case SolidForm::kSphere:
      AddSphere(solid.size_m, &part);
      break;
    case SolidForm::kCylinder:
      AddCylinder(solid.size_m, &part);
      break;
  }
  Mesh mesh;
  mesh.parts.push_back(std::move(part));
  return mesh;
}

}  // namespace tera
