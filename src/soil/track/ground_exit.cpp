#include "soil/track/ground_exit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tera {
namespace {

constexpr double kTouching_m = 1e-6;  ///< a shorter way takes the normal of the triangle

using Triangle = std::array<Vec3, 3>;

Vec3 UpwardNormal(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }

/// Nearest point on the segment from `a` to `b`.
Vec3 NearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  return a + std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) * ab;
}

/// Nearest point of a triangle: the foot of the perpendicular, or a point on the nearest side.
Vec3 NearestOn(const Triangle& t, const Vec3& p) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    inside = inside && n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0;
  }
  if (inside) return p - n * (n.dot(p - t[0]) / n.squaredNorm());
  Vec3 nearest = NearestOnSegment(p, t[0], t[1]);
  for (int k = 1; k < 3; ++k) {
    const Vec3 other = NearestOnSegment(p, t[k], t[(k + 1) % 3]);
    if ((other - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = other;
  }
  return nearest;
}

/// The two triangles of a cell, counterclockwise from above: south-east of the diagonal, then
/// north-west.
std::array<Triangle, 2> TrianglesOf(const Columns& ground, int i, int j) {
  const auto at = [&](int ci, int cj) {
    return Vec3(ground.x_m(ci), ground.y_m(cj), ground.TopAt(ci, cj));
  };
  const Vec3 sw = at(i, j), se = at(i + 1, j), nw = at(i, j + 1), ne = at(i + 1, j + 1);
  return {Triangle{sw, se, ne}, Triangle{sw, ne, nw}};
}

/// Searches the surface cell by cell for the point nearest to `p`.
class Search {
 public:
  Search(const Columns& ground, const Vec3& p) : ground_(ground), p_(p) {}

  void Start(double depth_m) {
    nearest_m2_ = depth_m * depth_m;
    direction_ = Vec3::UnitZ();
  }
  void LookAt(int i, int j) {
    const std::array<Triangle, 2> triangles = TrianglesOf(ground_, i, j);
    const auto& [sw, se, ne] = triangles[0];
    const Vec3 low = sw.cwiseMin(se).cwiseMin(ne).cwiseMin(triangles[1][2]);
    const double h = ground_.cell_m();
    const Vec3 least_way(std::max({low.x() - p_.x(), p_.x() - low.x() - h, 0.0}),
                         std::max({low.y() - p_.y(), p_.y() - low.y() - h, 0.0}),
                         std::max(low.z() - p_.z(), 0.0));
    if (least_way.squaredNorm() >= nearest_m2_) return;
    for (const Triangle& triangle : triangles) {
      const Vec3 way = NearestOn(triangle, p_) - p_;
      const double way_m2 = way.squaredNorm();
      if (way_m2 >= nearest_m2_) continue;
      nearest_m2_ = way_m2;
      direction_ = way_m2 > kTouching_m * kTouching_m ? Vec3(way / std::sqrt(way_m2))
                                                      : UpwardNormal(triangle);
    }
  }
  double nearest_m() const { return std::sqrt(nearest_m2_); }
  GroundExit found() const { return {nearest_m(), direction_}; }

 private:
  const Columns& ground_;
  Vec3 p_;
  double nearest_m2_ = 0;
  Vec3 direction_ = Vec3::UnitZ();
};

}  // namespace

std::optional<GroundExit> FindGroundExit(const Columns& ground, const Vec3& p_W_m) {
  if (ground.IsWellAbove(p_W_m)) return std::nullopt;
  const double h = ground.cell_m();
  const double gx = (p_W_m.x() - ground.x_m(0)) / h, gy = (p_W_m.y() - ground.y_m(0)) / h;
  if (!(gx >= 0 && gy >= 0 && gx < ground.nx() - 1 && gy < ground.ny() - 1)) {
    // Outside the site the ground continues at the height of the border.
    const double depth_m = ground.HeightAt(p_W_m.x(), p_W_m.y()) - p_W_m.z();
    if (depth_m <= 0) return std::nullopt;
    return GroundExit{depth_m, Vec3::UnitZ()};
  }
  const int ci = static_cast<int>(gx), cj = static_cast<int>(gy);
  const double u = gx - ci, v = gy - cj;
  const Triangle above = TrianglesOf(ground, ci, cj)[v > u];
  const Vec3 n = UpwardNormal(above);
  const double depth_m = n.dot(above[0] - p_W_m) / n.z();  // length of the way straight up
  if (depth_m <= 0) return std::nullopt;

  Search search(ground, p_W_m);
  search.Start(depth_m);
  search.LookAt(ci, cj);
  // Visits rings of cells while they can contain a nearer point.
  const double to_next_m = h * std::min({u, 1 - u, v, 1 - v});
  for (int ring = 1;; ++ring) {
    const double away_m = to_next_m + (ring - 1) * h;
    if (away_m >= std::min(search.nearest_m(), GroundExit::kReach_m)) break;
    for (int j = cj - ring; j <= cj + ring; ++j) {
      const int stride = std::abs(j - cj) == ring ? 1 : 2 * ring;
      for (int i = ci - ring; i <= ci + ring; i += stride) {
        if (i >= 0 && j >= 0 && i < ground.nx() - 1 && j < ground.ny() - 1) search.LookAt(i, j);
      }
    }
  }
  return search.found();
}

}  // namespace tera
