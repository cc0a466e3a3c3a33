#include "sim/heap_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "render/ground/lattice_noise.h"

namespace tera {
namespace {

constexpr double kHeapShare = 0.16;       // height of the mound over the mouth's length
constexpr double kShellClearance = 0.97;  // of the profile, so that soil does not cut the shell
constexpr int kAcross = 26, kAlong = 26;  // facets of the mound, as large as small clods
constexpr double kClods_m = 0.10;         // height of the clods on it

/// Adds a triangle with a flat normal that faces away from `inside`.
void AddTriangle(MeshPart* part, const Vec3& inside, const Vec3& a, const Vec3& b, const Vec3& c) {
  const bool inward = (b - a).cross(c - a).dot(a + b + c - 3 * inside) < 0;
  const Vec3& second = inward ? c : b;
  const Vec3& third = inward ? b : c;
  const Eigen::Vector3f n = (second - a).cross(third - a).normalized().cast<float>();
  for (const Vec3& p : {a, second, third}) {
    part->indices.push_back(static_cast<std::uint32_t>(part->positions_m.size()));
    part->positions_m.push_back(p.cast<float>());
    part->normals.push_back(n);
  }
}

}  // namespace

HeapMesh MakeHeapMesh(const Shovel& shovel, const Vec3& albedo) {
  const Vec2 lip = shovel.profile_B_m.back(), edge = shovel.profile_B_m.front();
  const Vec2 mouth = edge - lip;
  Vec2 out(mouth.y(), -mouth.x());  // away from the shell, one of the two normals of the mouth
  out.normalize();
  Vec2 deepest = lip;
  for (const Vec2& p : shovel.profile_B_m) {
    if (std::abs((p - lip).dot(out)) > std::abs((deepest - lip).dot(out))) deepest = p;
  }
  if ((deepest - lip).dot(out) > 0) out = -out;

  HeapMesh heap;
  heap.bottom_B_m = Vec3(deepest.x(), 0, deepest.y());
  heap.mesh.name = shovel.name + "_soil";
  MeshPart part;
  part.material.albedo = albedo;
  part.material.roughness = 0.95;

  const Vec2 middle = 0.5 * (lip + edge);
  const double half_m = 0.5 * shovel.width_m * kShellClearance;
  const auto point = [&](const Vec2& p, double y_m) {
    const Vec2 q = middle + kShellClearance * (p - middle);
    return Vec3(Vec3(q.x(), y_m, q.y()) - heap.bottom_B_m);
  };
  const Vec3 inside = point(0.7 * middle + 0.3 * deepest, 0);
  // The mound over the mouth: a bump with clods on it, zero along the rim.
  constexpr int kLattice = 8, kOctaves = 3;
  const LatticeNoise clods("heap", kLattice, kOctaves);
  const auto mound = [&](int i, int j) {
    const double u = static_cast<double>(i) / kAlong, v = 2.0 * j / kAcross - 1.0;
    const double bump = std::sin(kPi * u) * std::cos(0.5 * kPi * v);
    const double clod_m = kClods_m * (double(clods.At(u, 0.5 * v)) - 0.5);
    const double rise_m =
        bump * kHeapShare * mouth.norm() + std::sqrt(std::max(bump, 0.0)) * clod_m;
    return point(lip + u * mouth + rise_m * out, v * half_m);
  };
  for (int i = 0; i < kAlong; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      AddTriangle(&part, inside, mound(i, j), mound(i + 1, j), mound(i + 1, j + 1));
      AddTriangle(&part, inside, mound(i, j), mound(i + 1, j + 1), mound(i, j + 1));
    }
  }
  // The soil behind the mouth: floor strips and the two sides.
  for (std::size_t k = 0; k + 1 < shovel.profile_B_m.size(); ++k) {
    const Vec2 &a = shovel.profile_B_m[k], &b = shovel.profile_B_m[k + 1];
    AddTriangle(&part, inside, point(a, half_m), point(b, half_m), point(b, -half_m));
    AddTriangle(&part, inside, point(a, half_m), point(b, -half_m), point(a, -half_m));
    AddTriangle(&part, inside, point(middle, half_m), point(b, half_m), point(a, half_m));
    AddTriangle(&part, inside, point(middle, -half_m), point(a, -half_m), point(b, -half_m));
  }
  heap.mesh.parts.push_back(std::move(part));
  return heap;
}

}  // namespace tera
