#include "layout/sight/sighting.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tera {
namespace {

constexpr float kFarthestSeen_m = 300;
constexpr std::size_t kDirections = 6;
constexpr std::size_t kDown = 5;  ///< index of the downward direction

/// A line that is to be followed from `at_m` on.
struct Rest {
  std::size_t line = 0;
  double at_m = 0;
};

/// Ray along a line, from `at_m` to `before_m` before its end.
Ray RayOf(const Sighting::Line& line, double at_m, double before_m) {
  const Vec3 way_W_m = line.to_W_m - line.from_W_m;
  const double length_m = way_W_m.norm();
  const Vec3 d_W = length_m > 0 ? Vec3(way_W_m / length_m) : Vec3::UnitX();
  return {.origin_W_m = (line.from_W_m + at_m * d_W).cast<float>(),
          .direction_W = d_W.cast<float>(),
          .max_range_m = static_cast<float>(std::max(0.0, length_m - at_m - before_m))};
}

}  // namespace

Sighting::Sighting(const Scenario& scenario, const SceneAssembly& assembly, int threads)
    : scenario_(scenario), assembly_(assembly), threads_(threads), scene_(assembly.model()) {}

void Sighting::Show(const Instant& now, const TerrainSurface& ground) {
  scene_.Update({assembly_.BodyPoses(now)}, ground, assembly_.ShapesOf(now));
}

void Sighting::Follow(std::span<const Line> lines, double before_m, const GoesOn& goes_on) const {
  constexpr double kPast_m = 1e-4;  // the next ray starts this far behind a surface
  std::vector<Rest> rests(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) rests[i].line = i;
  while (!rests.empty()) {
    std::vector<Ray> rays;
    rays.reserve(rests.size());
    for (const Rest& rest : rests) rays.push_back(RayOf(lines[rest.line], rest.at_m, before_m));
    std::vector<RayHit> hits(rays.size());
    scene_.Trace(rays, hits, threads_);
    std::vector<Rest> further;
    for (std::size_t i = 0; i < rests.size(); ++i) {
      const auto [line, from_m] = rests[i];
      if (!hits[i].hit) continue;
      const Crossing crossing{hits[i].instance, from_m + hits[i].range_m, hits[i].leaves,
                              hits[i].opacity < 1};
      if (goes_on(line, crossing)) further.push_back({line, crossing.at_m + kPast_m});
    }
    rests = std::move(further);
  }
}

std::vector<std::optional<Blocked>> Sighting::Try(std::span<const Line> lines) const {
  std::vector<std::optional<Blocked>> blocked(lines.size());
  Follow(lines, kTouch_m, [&](std::size_t line, const Crossing& crossing) {
    if (crossing.is_glass && lines[line].through_glass) return true;
    blocked[line] = Blocked{crossing.instance};
    return false;
  });
  return blocked;
}

std::vector<std::vector<Sighting::Crossing>> Sighting::CrossingsOf(
    std::span<const Line> lines) const {
  std::vector<std::vector<Crossing>> crossings(lines.size());
  Follow(lines, 0, [&](std::size_t line, const Crossing& crossing) {
    crossings[line].push_back(crossing);
    return true;
  });
  return crossings;
}

std::vector<bool> Sighting::AreInside(const std::vector<Vec3>& places_W_m) const {
  const std::array<Eigen::Vector3f, kDirections> directions = {
      Eigen::Vector3f::UnitX(),  -Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(),
      -Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitZ(),  -Eigen::Vector3f::UnitZ()};
  std::vector<Ray> rays;
  rays.reserve(places_W_m.size() * kDirections);
  for (const Vec3& p_W_m : places_W_m) {
    for (const Eigen::Vector3f& d_W : directions) {
      rays.push_back(
          {.origin_W_m = p_W_m.cast<float>(), .direction_W = d_W, .max_range_m = kFarthestSeen_m});
    }
  }
  std::vector<RayHit> hits(rays.size());
  scene_.Trace(rays, hits, threads_);
  std::vector<bool> inside(places_W_m.size());
  for (std::size_t p = 0; p < places_W_m.size(); ++p) {
    const RayHit* around = &hits[p * kDirections];
    bool same = around[0].hit && around[0].instance != 0;
    for (std::size_t d = 1; d < kDirections; ++d) {
      const bool is_ground_below = d == kDown && around[d].instance == 0;
      same = same && around[d].hit && (is_ground_below || around[d].instance == around[0].instance);
    }
    inside[p] = same;
  }
  return inside;
}

std::vector<bool> Sighting::InstancesOf(std::size_t machine,
                                        bool (*is_wanted)(SemanticClass)) const {
  const std::string prefix = scenario_.machines[machine].placement.name + "/";
  std::vector<bool> wanted;
  for (const SceneInstance& instance : assembly_.model().instances) {
    wanted.push_back(instance.name.starts_with(prefix) && is_wanted(instance.label));
  }
  return wanted;
}

double Sighting::NearestOf(const std::vector<bool>& instances, const Vec3& from_W_m,
                           const Vec3& d_W, double farthest_m) const {
  constexpr double kPast_m = 1e-3;  // the next ray starts this far behind a skipped surface
  double at_m = 0;
  while (at_m < farthest_m) {
    const Ray ray{.origin_W_m = (from_W_m + at_m * d_W).cast<float>(),
                  .direction_W = d_W.cast<float>(),
                  .max_range_m = static_cast<float>(farthest_m - at_m)};
    RayHit hit;
    scene_.Trace(std::span(&ray, 1), std::span(&hit, 1), 1);
    if (!hit.hit) break;
    if (instances[hit.instance]) return at_m + hit.range_m;
    at_m += hit.range_m + kPast_m;
  }
  return farthest_m;
}

std::string Sighting::NameOf(const Blocked& blocked) const {
  return blocked.instance == 0 ? "ground" : assembly_.model().instances[blocked.instance].name;
}

}  // namespace tera
