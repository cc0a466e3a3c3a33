#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sim/dust/emission.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Dust emitted in a ball about a point.
struct DustPuff {
  Vec3 centre_W_m = Vec3::Zero();
  double radius_m = 0;
  DustMass mass_kg{};
};

/// Dust sources of a scenario's work, found from its visible effects: soil entering shovels,
/// falling clods, turning tracks and wheels, loose ground in the wind.
///
/// Frames  W.
/// Model   Loaded soil and falling clods emit DropEmission_kgpt of their mass; clods emit at their
///         landing place, scaled by DropHeightFactor of their fall. Each gear emits its share of
///         RoadEmission_kgpkm over its surface's travel, behind it. Newly disturbed loose ground
///         can lose ErosionPotential_gpm2, half of it in each kHalfLife_s, if the friction velocity
///         is above kThreshold_mps. The moisture is that of the local soil. In rain the surface is
///         wet; under snow no gear raises dust.
/// Omits   the soils' different silt contents, crusts, resuspension of settled dust, soil that a
///         blade pushes.
/// Source  emission.h. kThreshold_mps: AP-42 table 13.2.5-2, overburden. kHalfLife_s: 13.2.5.1, "a
///         few minutes".
class DustSources {
 public:
  static constexpr double kThreshold_mps = 1.02;
  static constexpr double kHalfLife_s = 120;

  /// Keeps a reference to `scenario`, which must have dust.
  explicit DustSources(const Scenario& scenario);
  /// Adds the dust of a physics step, except from clods and wind.
  void AddWork(const WorldStep& step, std::vector<DustPuff>* puffs) const;
  /// Adds the dust of clods that have landed since the last call. Call at least 20 times a second.
  void AddFalls(const TerrainSurface& ground, std::vector<DustPuff>* puffs);
  /// Adds the wind erosion of loose ground over `dt_s`.
  void AddBlown(const TerrainSurface& ground, double dt_s, std::vector<DustPuff>* puffs);

 private:
  /// A falling clod.
  struct Fall {
    Eigen::Vector3f p_W_m;
    float top_m;
    float radius_m;
    std::uint8_t soil, moisture;
  };
  /// Loose ground in a square.
  struct Patch {
    double loose_m2 = 0, potential_kg = 0;
  };
  double SurfaceMoisture_percent(const TerrainSurface& ground, const Vec2& xy_W_m) const;
  double Moisture_percent(std::uint8_t soil, std::uint8_t moisture) const;
  void AddCut(const WorldStep& step, std::size_t m, std::vector<DustPuff>* puffs) const;
  void AddDriving(const WorldStep& step, std::size_t m, std::vector<DustPuff>* puffs) const;
  void FindLoose(const TerrainSurface& ground, int a, int b);

  const Scenario& scenario_;
  const DustModel& model_;
  const Weather& weather_;
  double potential_gpm2_;
  std::multimap<std::uint16_t, Fall> falls_;  ///< by the clods' numbers
  std::vector<std::uint32_t> tile_version_;
  std::vector<Patch> patches_;  ///< one per tile
};

}  // namespace tera
