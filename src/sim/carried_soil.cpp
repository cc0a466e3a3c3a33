#include "sim/carried_soil.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "render/ground/lattice_noise.h"
#include "render/ground/soil_colour.h"
#include "soil/columns/soil_type.h"
#include "soil/tool/heap_surface.h"

namespace tera {
namespace {

constexpr int kCellsAcross = 36;     ///< across a shovel's width
constexpr double kLeastLoad = 1e-4;  ///< share of the capacity; a smaller load is not shown
constexpr double kSkirt_m = 0.006;   ///< the skirt's distance from the shell
constexpr double kRoughness = 0.95;
constexpr double kToneRange = 0.30;  ///< range of brightness between grains
/// Share of the colour that comes from the point's own soil; the rest is the mean.
constexpr double kUnmixed = 0.25;

/// Surface noise of clods: rounded tops with creases between them.
///
/// Model   size and depth are estimates. Dry sand has ripples of a few millimetres, clay has lumps
///         as large as a fist.
struct Clods {
  double size_m, depth_m;

  explicit Clods(const SoilType& soil) {
    constexpr double kLumpy_pa = 8e3;
    const double lumpiness = std::min(1.0, soil.cohesion_pa / kLumpy_pa);
    size_m = 0.06 + 0.05 * lumpiness;
    depth_m = 0.010 + 0.032 * lumpiness + 0.3 * soil.grain_size_m;
  }
  /// Depth of the surface below the clods' tops.
  double Depth_m(double along_m, double across_m) const {
    constexpr int kPeriod = 16;
    static const LatticeNoise noise("carried_soil/clods", kPeriod, 3);
    const double n =
        double(noise.At(along_m / (kPeriod * size_m), across_m / (kPeriod * size_m) + 0.5));
    return depth_m * (1 - std::min(1.0, 3.5 * std::abs(n - 0.5)));
  }
};

/// Random number in [0, 1], constant within each square of 11 mm of the shovel's opening.
double GrainNumber(const Vec2& place_m, double offset) {
  constexpr int kPeriod = 128;
  constexpr double kGrain_m = 0.011;
  static const LatticeNoise noise("carried_soil/grains", kPeriod, 1);
  const auto square = [](double at_m) { return std::floor(at_m / kGrain_m) / kPeriod; };
  return double(noise.At(square(place_m.x()) + offset, square(place_m.y()) + offset));
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Border edges of the surface: those of a single triangle, in that triangle's direction.
std::vector<Edge> BorderOf(const HeapSurface& surface) {
  std::vector<std::pair<Edge, Edge>> edges;  // sorted ends, and the ends in the triangle's order
  for (const auto& t : surface.triangles) {
    for (int e = 0; e < 3; ++e) {
      const Edge edge(t[e], t[(e + 1) % 3]);
      edges.emplace_back(std::minmax(edge.first, edge.second), edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> border;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool is_shared = (k > 0 && edges[k - 1].first == edges[k].first) ||
                           (k + 1 < edges.size() && edges[k + 1].first == edges[k].first);
    if (!is_shared) border.push_back(edges[k].second);
  }
  return border;
}

/// Adds a skirt from the surface's border down to the shell. Its lower edge stays slightly inside
/// the shell.
void AddSkirt(const HeapSurface& surface, MeshPart* part) {
  if (surface.p_B_m.empty()) return;
  const Vec3 sum =
      std::accumulate(surface.floor_B_m.begin(), surface.floor_B_m.end(), Vec3(0, 0, 0));
  const Vec3 middle_B_m = sum / static_cast<double>(surface.floor_B_m.size());
  const auto add = [&](const Vec3& p_B_m, std::uint32_t as) {
    part->positions_m.push_back(p_B_m.cast<float>());
    part->albedos.push_back(part->albedos[as]);
    return static_cast<std::uint32_t>(part->positions_m.size() - 1);
  };
  for (const auto& [a, b] : BorderOf(surface)) {
    const auto low = [&](std::uint32_t k) {
      const Vec3& floor_B_m = surface.floor_B_m[k];
      return Vec3(floor_B_m + kSkirt_m * (middle_B_m - floor_B_m).normalized());
    };
    const std::uint32_t a_top = add(surface.p_B_m[a], a), b_top = add(surface.p_B_m[b], b);
    const std::uint32_t a_low = add(low(a), a), b_low = add(low(b), b);
    for (const std::uint32_t k : {a_top, a_low, b_low, a_top, b_low, b_top}) {
      part->indices.push_back(k);
    }
  }
}

/// Area-weighted vertex normals.
void SetNormals(MeshPart* part) {
  part->normals.assign(part->positions_m.size(), Eigen::Vector3f::Zero());
  for (std::size_t t = 0; t < part->indices.size(); t += 3) {
    const std::uint32_t* i = &part->indices[t];
    const Eigen::Vector3f& a = part->positions_m[i[0]];
    const Eigen::Vector3f n = (part->positions_m[i[1]] - a).cross(part->positions_m[i[2]] - a);
    for (int k = 0; k < 3; ++k) part->normals[i[k]] += n;
  }
  for (Eigen::Vector3f& n : part->normals) {
    n = n.norm() > 0 ? Eigen::Vector3f(n.normalized()) : Eigen::Vector3f::UnitZ();
  }
}

/// The soil that a uniform number in [0, 1] selects, with the shares as probabilities.
std::size_t Drawn(const std::vector<double>& shares, double number) {
  std::size_t soil = 0;
  while (soil + 1 < shares.size() && number >= shares[soil]) number -= shares[soil++];
  return soil;
}

}  // namespace

std::vector<double> VolumeShares(const SoilReaction::Load& load,
                                 const std::vector<SoilType>& soils) {
  std::vector<double> shares(soils.size(), 0.0);
  double sum = 0;
  for (std::size_t s = 0; s < soils.size() && s < load.soil_kg.size(); ++s) {
    shares[s] = load.soil_kg[s] / LooseDensity_kgpm3(soils[s]);
    sum += shares[s];
  }
  if (sum <= 0) {
    shares.front() = sum = 1;
  }
  for (double& share : shares) share /= sum;
  return shares;
}

Vec3 LooseAlbedo(const SoilType& soil) { return soil.albedo * SoilTone(soil.moisture, 1.0); }

CarriedSoil::CarriedSoil(const Shovel& shovel, const std::vector<SoilType>& soils)
    : shovel_(shovel), soils_(soils) {}

std::shared_ptr<const ShapedMesh> CarriedSoil::Shape(const SoilReaction::Load& load,
                                                     const Pose& X_WB) const {
  if (load.volume_m3 <= kLeastLoad * shovel_.capacity_m3) return nullptr;
  const std::vector<double> shares = VolumeShares(load, soils_);
  const auto main = std::max_element(load.soil_kg.begin(), load.soil_kg.end());
  const SoilType& main_soil = soils_[load.soil_kg.empty() ? 0 : main - load.soil_kg.begin()];
  const Vec3 up_B = X_WB.linear().row(2).transpose();
  const Vec3 lies_B = load.surface_up_B.isZero() ? up_B : load.surface_up_B;
  const Clods clods(main_soil);
  const HeapSurface surface = MakeHeapSurface(
      ShovelShape(shovel_), {load.volume_m3, up_B, lies_B, main_soil.repose_angle_rad},
      shovel_.width_m / kCellsAcross,
      [&](double along_m, double across_m) { return clods.Depth_m(along_m, across_m); });

  MeshPart part;
  part.material.roughness = kRoughness;
  part.material.albedo = Vec3::Zero();
  for (std::size_t s = 0; s < soils_.size(); ++s) {
    part.material.albedo += shares[s] * LooseAlbedo(soils_[s]);
  }
  auto shape = std::make_shared<ShapedMesh>();
  shape->volume_m3 = load.volume_m3;
  shape->mass_kg = load.mass_kg;
  shape->key = {load.volume_m3, up_B.x(), up_B.y(), up_B.z(), lies_B.x(), lies_B.y(), lies_B.z()};
  shape->key.insert(shape->key.end(), load.soil_kg.begin(), load.soil_kg.end());
  shape->box_min_B_m = Vec3::Constant(std::numeric_limits<double>::infinity());
  shape->box_max_B_m = -shape->box_min_B_m;
  for (std::size_t k = 0; k < surface.p_B_m.size(); ++k) {
    const SoilType& soil = soils_[Drawn(shares, GrainNumber(surface.place_m[k], 0))];
    const double tone = 1 + kToneRange * (GrainNumber(surface.place_m[k], 0.5) - 0.5);
    const Vec3 mixed = kUnmixed * LooseAlbedo(soil) + (1 - kUnmixed) * part.material.albedo;
    part.positions_m.push_back(surface.p_B_m[k].cast<float>());
    part.albedos.push_back((tone * mixed).cast<float>());
    for (const Vec3& p_B_m : {surface.p_B_m[k], surface.floor_B_m[k]}) {
      shape->box_min_B_m = shape->box_min_B_m.cwiseMin(p_B_m);
      shape->box_max_B_m = shape->box_max_B_m.cwiseMax(p_B_m);
    }
  }
  for (const auto& t : surface.triangles)
    part.indices.insert(part.indices.end(), t.begin(), t.end());
  if (part.indices.empty()) return nullptr;
  AddSkirt(surface, &part);
  SetNormals(&part);
  shape->parts.push_back(std::move(part));
  return shape;
}

}  // namespace tera
