#include "render/ground/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/ground/lattice_noise.h"
#include "render/meshes/near_infrared.h"

namespace tera {
namespace {

// Distance of each ring from the site's border. The first ring hangs below the border as a skirt.
constexpr std::array<double, 20> kRings_m = {
    0,  0,  1.5, 3,   5,   8,   12,  17,  24,  33,
    45, 60, 80,  110, 150, 220, 320, 500, 850, Surroundings::kReach_m};
constexpr double kSkirt_m = 0.5;
constexpr int kStepsPerSide = 50, kAround = 4 * kStepsPerSide;
constexpr float kTrodden = 0.75f;  // albedo of the ground near the site relative to the dry soil
constexpr double kHills_m = 9.0;   // greatest height of the far hills
constexpr double kHillsBegin_m = 60.0, kHillsFull_m = 500.0;
constexpr double kTrees_m = 11.0;  // height of the tree belt
constexpr double kTreesAt_m = 320.0, kTreesWidth_m = 60.0;
// Forest in the meadows: from no to full density.
constexpr double kForestBegin_m = 150.0, kForestFull_m = 320.0;
constexpr double kMeadowBegin_m = 2.0, kMeadowFull_m = 16.0;  // transition from soil to grass
constexpr double kMeadowFringe_m = 14.0;                      // width of the uneven transition
// Linear colours: meadow, dry patches in it, woods.
const Eigen::Vector3f kMeadow(0.16f, 0.17f, 0.075f), kDryMeadow(0.05f, 0.03f, 0.01f);
const Eigen::Vector3f kWoods(0.045f, 0.065f, 0.03f);

double Ramp(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A point on the site's border, number k around it, and the outward direction there.
struct BorderPoint {
  Vec2 p_W_m, outward;
};

BorderPoint Border(const TerrainSurface& t, int k) {
  const Vec2 size = t.cell_m * Vec2(t.nx - 1, t.ny - 1);
  const int side = k / kStepsPerSide;
  const double s = static_cast<double>(k % kStepsPerSide) / kStepsPerSide;
  const std::array<Vec2, 5> corners = {Vec2(0, 0), Vec2(size.x(), 0), size, Vec2(0, size.y()),
                                       Vec2(0, 0)};
  const Vec2 local = corners[side] + s * (corners[side + 1] - corners[side]);
  return {t.origin_W_m + local, (local - 0.5 * size).normalized()};
}

}  // namespace

Surroundings::Surroundings(const TerrainSurface& terrain, const std::vector<SoilAppearance>& soils)
    : soil_albedo_((soils.empty() ? SoilAppearance{} : soils.front()).albedo.cast<float>() *
                   kTrodden) {
  vertices_.resize(kRings_m.size() * kAround);
  for (int ring = 0; ring + 1 < static_cast<int>(kRings_m.size()); ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const int a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      for (int v : {a, a + kAround, b + kAround, a, b + kAround, b}) {
        indices_.push_back(static_cast<std::uint16_t>(v));
      }
    }
  }
  Update(terrain);
}

void Surroundings::Place(const TerrainSurface& terrain) {
  static const LatticeNoise hills("render/apron/hills", 7, 5);
  static const LatticeNoise colour("render/apron/colour", 24, 5);
  constexpr double kTile_m = 2 * kReach_m + 400.0;
  double mean_m = 0;
  for (int k = 0; k < kAround; ++k) {
    const Vec2 p = Border(terrain, k).p_W_m;
    mean_m += terrain.HeightAt(p.x(), p.y()) / kAround;
  }
  for (std::size_t ring = 0; ring < kRings_m.size(); ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const BorderPoint border = Border(terrain, k);
      const double d_m = kRings_m[ring];
      const Vec2 p = border.p_W_m + d_m * border.outward;
      const double border_m = terrain.HeightAt(border.p_W_m.x(), border.p_W_m.y());
      const double u = p.x() / kTile_m, v = p.y() / kTile_m;
      const double hill_m = kHills_m * (hills.At(u * 3, v * 3) - 0.35) * 2;
      double z = border_m + (mean_m - border_m) * Ramp(d_m, 0, 40) +
                 hill_m * Ramp(d_m, kHillsBegin_m, kHillsFull_m);
      const double tree = 1 - Ramp(std::abs(d_m - kTreesAt_m), 1, kTreesWidth_m);
      const float n = colour.At(u * 60, v * 60), broad = colour.At(u * 7, v * 7);
      z += tree * kTrees_m * (0.4 + 1.1 * n);
      if (ring == 0) z -= kSkirt_m;
      const Eigen::Vector3f meadow = kMeadow * (0.65f + 0.7f * n) + kDryMeadow * broad;
      const auto green = static_cast<float>(
          Ramp(d_m + kMeadowFringe_m * (n - 0.5), kMeadowBegin_m, kMeadowFull_m));
      const auto wooded = static_cast<float>(
          std::max(tree, Ramp(broad, 0.52, 0.6) * Ramp(d_m, kForestBegin_m, kForestFull_m)));
      Eigen::Vector3f albedo = soil_albedo_ + green * (meadow - soil_albedo_);
      albedo += wooded * (kWoods - albedo);
      Vertex& vertex = vertices_[ring * kAround + k];
      vertex.position_W_m = Vec3(p.x(), p.y(), z).cast<float>();
      vertex.albedo_root = albedo.cwiseMax(0.0f).cwiseSqrt();
      const float leaves = 1 - (1 - green) * (1 - wooded);
      const auto bare = static_cast<float>(SoilNearInfrared(soil_albedo_.cast<double>()));
      vertex.near_infrared = bare + leaves * (static_cast<float>(kLeafNearInfrared) - bare);
    }
  }
}

void Surroundings::Update(const TerrainSurface& terrain) {
  Place(terrain);
  const int rings = static_cast<int>(kRings_m.size());
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const auto at = [&](int r, int m) {
        return vertices_[std::clamp(r, 1, rings - 1) * kAround + (m + kAround) % kAround]
            .position_W_m;
      };
      const Eigen::Vector3f out = at(std::max(ring, 1) + 1, k) - at(ring - 1, k);
      const Eigen::Vector3f along = at(ring, k + 1) - at(ring, k - 1);
      const Eigen::Vector3f normal = out.cross(along);
      vertices_[ring * kAround + k].normal =
          normal.z() > 0 ? Eigen::Vector3f(normal.normalized()) : Eigen::Vector3f::UnitZ();
    }
  }
}

}  // namespace tera
