#include "sim/dust/dust_sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"
#include "soil/soil.h"

namespace tera {
namespace {

constexpr double kTonne_kg = 1000;
constexpr double kCutBall_m = 0.6, kGearBall_m = 0.7;
// Falling soil pushes air outwards along the ground. The ball therefore grows with the height of
// the fall.
constexpr double kFallBall_m = 0.5, kFallBallGrows = 0.35;
constexpr double kGearRise_m = 0.25;  ///< height of the ball's centre above a gear's trailing end
constexpr double kLeastFall_m = 0.1;  ///< clods with a shorter fall emit no dust
constexpr double kMostStep_m = 1.0;   ///< largest motion of a clod between two calls
constexpr std::uint8_t kLoose = 128;  ///< looseness from which ground counts as loose
constexpr double kGramsPerKg = 1000;

DustMass Times(const DustMass& mass, double factor) {
  DustMass product = mass;
  for (double& kg : product) kg *= factor;
  return product;
}

/// The trailing end of a running gear on the ground: of the patches that face down, the rearmost in
/// the driving direction.
Vec3 TrailingEnd(const RunningGear& gear, double rate_radps) {
  Vec3 end_B_m = gear.patches.front().p_B_m;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const ContactPatch& patch : gear.patches) {
    if (patch.outward_B.z() > -0.7) continue;
    const double along = (rate_radps > 0 ? -1 : 1) * patch.p_B_m.x();
    if (along > farthest) farthest = along, end_B_m = patch.p_B_m;
  }
  return end_B_m;
}

}  // namespace

DustSources::DustSources(const Scenario& scenario)
    : scenario_(scenario),
      model_(*scenario.environment.weather.dust),
      weather_(scenario.environment.weather),
      potential_gpm2_(
          ErosionPotential_gpm2(FrictionVelocity_mps(weather_.wind.speed_mps), kThreshold_mps)) {}

double DustSources::Moisture_percent(std::uint8_t soil, std::uint8_t moisture) const {
  const std::vector<SoilType>& soils = scenario_.site->soils();
  const SoilType& type = soils[std::min<std::size_t>(soil, soils.size() - 1)];
  return WaterByMass_percent(moisture / 255.0, type.bank_density_kgpm3);
}

double DustSources::SurfaceMoisture_percent(const TerrainSurface& ground,
                                            const Vec2& xy_W_m) const {
  const Vec2 place = (xy_W_m - ground.origin_W_m) / ground.cell_m;
  const int i = std::clamp(static_cast<int>(std::lround(place.x())), 0, ground.nx - 1);
  const int j = std::clamp(static_cast<int>(std::lround(place.y())), 0, ground.ny - 1);
  const TerrainSurface::Cover cover = ground.at(i, j).cover;
  return Moisture_percent(cover.soil, weather_.rain_mmph > 0 ? 255 : cover.moisture);
}

void DustSources::AddCut(const WorldStep& step, std::size_t m, std::vector<DustPuff>* puffs) const {
  const MachineState &before = step.before.machines[m], &after = step.after.machines[m];
  const std::vector<Shovel>& shovels = scenario_.machines[m].placement.model.ground_tools.shovels;
  if (before.shovel_load.size() != shovels.size()) return;
  if (after.shovel_load.size() != shovels.size()) return;
  for (std::size_t s = 0; s < shovels.size(); ++s) {
    const double taken_kg = after.shovel_load[s].mass_kg - before.shovel_load[s].mass_kg;
    if (taken_kg <= 0) continue;
    const Vec2& edge_m = shovels[s].profile_B_m.front();
    const Vec3 edge_W_m = after.links[shovels[s].link].X_WB * Vec3(edge_m.x(), 0, edge_m.y());
    const double moisture = SurfaceMoisture_percent(step.ground, edge_W_m.head<2>());
    const DustMass of_tonne_kg = DropEmission_kgpt(weather_.wind.speed_mps, moisture);
    puffs->push_back({edge_W_m, kCutBall_m, Times(of_tonne_kg, taken_kg / kTonne_kg)});
  }
}

void DustSources::AddDriving(const WorldStep& step, std::size_t m,
                             std::vector<DustPuff>* puffs) const {
  constexpr double kLeast_radps = 1e-3;
  const MachineState& machine = step.after.machines[m];
  const GroundTools& tools = scenario_.machines[m].placement.model.ground_tools;
  if (weather_.snow_depth_m > 0 || machine.gear_rate_radps.size() != tools.gears.size()) return;
  const double dt_s = ToSeconds(step.after.t_ns - step.before.t_ns);
  const DustMass of_km_kg = RoadEmission_kgpkm(model_.silt_percent, tools.mass_kg);
  for (std::size_t g = 0; g < tools.gears.size(); ++g) {
    const RunningGear& gear = tools.gears[g];
    const double rate_radps = machine.gear_rate_radps[g];
    if (gear.patches.empty() || std::abs(rate_radps) < kLeast_radps) continue;
    const double way_km = std::abs(rate_radps) * gear.ShoeRadius_m() * dt_s / 1000;
    const Vec3 end_W_m = machine.links[gear.link].X_WB * TrailingEnd(gear, rate_radps);
    const double dry = MoistRoadShare(SurfaceMoisture_percent(step.ground, end_W_m.head<2>()));
    const double share = dry * way_km / static_cast<double>(tools.gears.size());
    puffs->push_back({end_W_m + kGearRise_m * Vec3::UnitZ(), kGearBall_m, Times(of_km_kg, share)});
  }
}

void DustSources::AddWork(const WorldStep& step, std::vector<DustPuff>* puffs) const {
  for (std::size_t m = 0; m < step.after.machines.size(); ++m) {
    AddCut(step, m, puffs);
    AddDriving(step, m, puffs);
  }
}

void DustSources::AddFalls(const TerrainSurface& ground, std::vector<DustPuff>* puffs) {
  std::multimap<std::uint16_t, Fall> now;
  for (const TerrainSurface::Grain& grain : ground.grains()) {
    Fall fall{grain.p_W_m, grain.p_W_m.z(), grain.radius_m, grain.soil, grain.moisture};
    // Several clods may have the same number, because the clods shown in beds have numbers too. The
    // nearest clod with this number is the same one.
    auto same = falls_.end();
    float nearest_m = kMostStep_m;
    const auto [first, last] = falls_.equal_range(grain.number);
    for (auto f = first; f != last; ++f) {
      const float apart_m = (f->second.p_W_m - grain.p_W_m).norm();
      if (apart_m < nearest_m) nearest_m = apart_m, same = f;
    }
    if (same != falls_.end()) {
      fall.top_m = std::max(same->second.top_m, fall.top_m);
      falls_.erase(same);
    }
    now.emplace(grain.number, fall);
  }
  const std::vector<SoilType>& soils = scenario_.site->soils();
  for (const auto& [number, fall] : falls_) {
    const double fall_m = fall.top_m - fall.p_W_m.z();
    if (fall_m < kLeastFall_m) continue;
    const SoilType& soil = soils[std::min<std::size_t>(fall.soil, soils.size() - 1)];
    const double loose_kgpm3 = soil.bank_density_kgpm3 / soil.swell;
    const double mass_kg = 4 * kPi / 3 * std::pow(fall.radius_m, 3) * loose_kgpm3;
    const DustMass of_tonne_kg =
        DropEmission_kgpt(weather_.wind.speed_mps, Moisture_percent(fall.soil, fall.moisture));
    const double ball_m = kFallBall_m + kFallBallGrows * fall_m;
    puffs->push_back({fall.p_W_m.cast<double>() + 0.5 * ball_m * Vec3::UnitZ(), ball_m,
                      Times(of_tonne_kg, DropHeightFactor(fall_m) * mass_kg / kTonne_kg)});
  }
  falls_ = std::move(now);
}

/// Sums the loose ground of a tile, weighted by its dryness. An increase since the last call counts
/// as newly disturbed.
void DustSources::FindLoose(const TerrainSurface& ground, int a, int b) {
  constexpr int kCells = TerrainGrid::kTileCells;
  const double vertex_m2 = ground.cell_m * ground.cell_m;
  double loose_m2 = 0;
  for (int j = b * kCells; j < std::min((b + 1) * kCells, ground.ny); ++j) {
    for (int i = a * kCells; i < std::min((a + 1) * kCells, ground.nx); ++i) {
      const TerrainSurface::Cover cover = ground.at(i, j).cover;
      if (cover.looseness < kLoose) continue;
      loose_m2 += vertex_m2 * MoistRoadShare(Moisture_percent(cover.soil, cover.moisture));
    }
  }
  Patch& patch = patches_[ground.tile_index(a, b)];
  patch.potential_kg += std::max(loose_m2 - patch.loose_m2, 0.0) * potential_gpm2_ / kGramsPerKg;
  patch.loose_m2 = loose_m2;
}

void DustSources::AddBlown(const TerrainSurface& ground, double dt_s,
                           std::vector<DustPuff>* puffs) {
  if (potential_gpm2_ <= 0 || weather_.rain_mmph > 0 || weather_.snow_depth_m > 0) return;
  tile_version_.resize(ground.tile_count(), 0);
  patches_.resize(ground.tile_count());
  const double lost = 1 - std::exp2(-dt_s / kHalfLife_s);
  const double half_m = 0.5 * TerrainGrid::kTileCells * ground.cell_m;
  for (int b = 0; b < ground.tiles_y(); ++b) {
    for (int a = 0; a < ground.tiles_x(); ++a) {
      const int tile = ground.tile_index(a, b);
      if (ground.IsRefined(a, b) && tile_version_[tile] != ground.tile_version(a, b)) {
        tile_version_[tile] = ground.tile_version(a, b);
        FindLoose(ground, a, b);
      }
      Patch& patch = patches_[tile];
      if (patch.potential_kg <= 0) continue;
      const Vec2 middle_W_m = ground.origin_W_m + half_m * Vec2(2 * a + 1, 2 * b + 1);
      const Vec3 low_W_m(middle_W_m.x(), middle_W_m.y(),
                         ground.HeightAt(middle_W_m.x(), middle_W_m.y()));
      puffs->push_back({low_W_m, half_m, WindErosion_kg(lost * patch.potential_kg)});
      patch.potential_kg -= lost * patch.potential_kg;
    }
  }
}

}  // namespace tera
