#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/soil_kinds.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// Weather that stays the same for some hours.
struct WeatherSpell {
  double hours = 0, rain_mmph = 0, evaporation_mmpd = 0;

  double duration_s() const { return hours * kHour_s; }
  double rain_mps() const { return rain_mmph * kMillimetre_m / kHour_s; }
  double evaporation_mps() const { return evaporation_mmpd * kMillimetre_m / kDay_s; }

 private:
  static constexpr double kHour_s = 3600, kDay_s = 86400, kMillimetre_m = 1e-3;
};
inline constexpr double kMostRain_mmph = 200, kMostEvaporation_mmpd = 20;

/// Where the rain of some spells has gone, as heights of water.
struct WaterBalance {
  double rained_m = 0, ran_off_m = 0, evaporated_m = 0, drained_m = 0;
  double stored_m = 0;  ///< more than before
};

/// A slice of ground and its water, as heights.
struct WaterSlice {
  Stratum soil;  ///< as before all weather; it ends lower
  SoilWater water;
  double thickness_m = 0, capacity_m = 0, water_m = 0;
  double out_m = 0;  ///< in a step

  double moisture() const { return capacity_m > 0 ? water_m / capacity_m : soil.moisture; }
};

/// The water of a profile under weather.
///
/// Model   Water moves down by its weight alone, at the local conductivity (kinematic wave),
///         through slices of at most 0.1 m to 2 m of depth. There it drains freely. A full slice
///         holds up the water from above; water that the surface does not take runs off. The
///         surface's slice evaporates the potential rate while it holds three quarters of its
///         field capacity (suction of 33 kPa), below in proportion.
/// Omits   suction between slices, which wets sharper fronts' edges and lifts water; air that is
///         trapped; water that stands or flows on the surface, or sideways.
/// Source  Smith 1983, Water Resources Research 19(3); Niswonger, Prudic and Regan 2006, USGS
///         Techniques and Methods 6-A19; evaporation: Manabe 1969, Monthly Weather Review 97(11),
///         of the 0.1 m of Allen et al. 1998, FAO Irrigation and Drainage Paper 56.
class Seepage {
 public:
  Seepage(const std::vector<SoilType>& soils, const GroundProfile& profile);

  void Run(const WeatherSpell& weather, double duration_s);
  const std::vector<WaterSlice>& slices() const { return slices_; }
  const WaterBalance& balance() const { return balance_; }
  /// Strata of the slices, with their moisture and density. Neighbours of one stratum and about one
  /// moisture are joined. Below them the profile goes on.
  GroundProfile Profile() const;

 private:
  void Step(double rain_m, double evaporation_m, double dt_s);

  GroundProfile before_;
  std::vector<WaterSlice> slices_;
  double step_s_;
  WaterBalance balance_;
};

/// Lets weather act on a profile.
WaterBalance Seep(const std::vector<WeatherSpell>& weather, const std::vector<SoilType>& soils,
                  GroundProfile* profile);

/// Reads `weather_before`.
std::vector<WeatherSpell> ReadWeatherBefore(const ConfigMap& config);

/// The profile, each stratum of the kind that is nearest to its moisture.
GroundProfile OfKinds(const SoilKinds& kinds, const GroundProfile& profile);

/// Lets weather act on all profiles. Adds a kind, to the per cent of moisture, for soil whose
/// moisture differs from its kind's. Returns false if there is no room for it.
bool Wet(const std::vector<WeatherSpell>& weather, SoilKinds* kinds,
         std::vector<GroundProfile>* profiles);

}  // namespace tera
