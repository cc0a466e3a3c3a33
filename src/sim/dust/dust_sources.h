#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sim/dust/emission.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Dust that comes into the air in a ball about a point.
struct DustPuff {
  Vec3 centre_W_m = Vec3::Zero();
  double radius_m = 0;
  DustMass mass_kg{};
};

/// Where the work of a scenario raises dust, found from what can be seen of it: soil that comes
/// into shovels, clods that fall, tracks and wheels that turn, loose ground in the wind.
///
/// Frames  W.
/// Model   Soil taken up and clods that fall give off DropEmission_kgpt of their mass, clods times
///         DropHeightFactor of their fall, where they land, gear RoadEmission_kgpkm of a way as
///         long as that which its surface makes, each its share, behind it. Loose ground that is
///         disturbed anew has ErosionPotential_gpm2 to lose, half of it in each kHalfLife_s, if its
///         friction velocity is above kThreshold_mps. The moisture is that of the soil there; in
///         rain the surface is wet, and under snow no gear raises dust.
/// Omits   soils' different shares of silt, crusts, dust that has settled and is raised again, soil
///         that a blade pushes.
/// Source  emission.h. kThreshold_mps: AP-42 table 13.2.5-2, overburden. kHalfLife_s: 13.2.5.1, "a
///         few minutes".
class DustSources {
 public:
  static constexpr double kThreshold_mps = 1.02;
  static constexpr double kHalfLife_s = 120;

  /// Keeps a reference to `scenario`, which has dust.
  explicit DustSources(const Scenario& scenario);
  /// What a step of the physics raises, but for clods and wind.
  void AddWork(const WorldStep& step, std::vector<DustPuff>* puffs) const;
  /// What clods raise that have come down since the last call. At least 20 times a second.
  void AddFalls(const TerrainSurface& ground, std::vector<DustPuff>* puffs);
  /// What the wind takes from loose ground in `dt_s`.
  void AddBlown(const TerrainSurface& ground, double dt_s, std::vector<DustPuff>* puffs);

 private:
  /// A clod on its way.
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
  std::vector<Patch> patches_;  ///< of each tile
};

}  // namespace tera
