#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sim/dust/emission.h"
#include "sim/scenario/scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Dust emitted at once, within a ball around a point.
struct DustPuff {
  Vec3 centre_W_m = Vec3::Zero();
  double radius_m = 0;
  DustMass mass_kg{};
};

/// Dust sources of a scenario's work. They are derived from its visible effects: soil that enters
/// shovels, falling clods, turning tracks and wheels, loose ground in the wind.
///
/// Frames  W.
/// Model   soil that enters a shovel emits DropEmission_kgpt of its mass at the cutting edge. A
///         falling clod emits likewise where it lands, times DropHeightFactor of its fall.
///         A machine emits RoadEmission_kgpkm, shared equally between its running gears. The
///         distance is the travel of the gear's surface; the dust rises at the gear's trailing end.
///         Newly loosened ground can lose ErosionPotential_gpm2 if the friction velocity exceeds
///         kThreshold_mps. It loses half of the rest in each kHalfLife_s.
///         The moisture is that of the local soil. In rain the surface is saturated. Under snow,
///         driving raises no dust.
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
  /// Adds the dust of shovels and running gear in a physics step.
  void AddWork(const WorldStep& step, std::vector<DustPuff>* puffs) const;
  /// Adds the dust of clods that have landed since the last call. Must be called at least 20 times
  /// per second.
  void AddFalls(const TerrainSurface& ground, std::vector<DustPuff>* puffs);
  /// Adds the wind erosion of loose ground over `dt_s`.
  void AddBlown(const TerrainSurface& ground, double dt_s, std::vector<DustPuff>* puffs);

 private:
  /// A clod in the air, with the top of its fall.
  struct Fall {
    Eigen::Vector3f p_W_m;
    float top_m;
    float radius_m;
    std::uint8_t soil, moisture;
  };
  /// The loose ground of one terrain tile.
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
  std::multimap<std::uint16_t, Fall> falls_;  ///< by the clod's number
  std::vector<std::uint32_t> tile_version_;
  std::vector<Patch> patches_;  ///< one per tile
};

}  // namespace tera
