#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/soil_kinds.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// A period of constant weather.
struct WeatherSpell {
  double hours = 0, rain_mmph = 0, evaporation_mmpd = 0;

  double duration_s() const { return hours * kHour_s; }
  double rain_mps() const { return rain_mmph * kMillimetre_m / kHour_s; }
  double evaporation_mps() const { return evaporation_mmpd * kMillimetre_m / kDay_s; }

 private:
  static constexpr double kHour_s = 3600, kDay_s = 86400, kMillimetre_m = 1e-3;
};
inline constexpr double kMostRain_mmph = 200, kMostEvaporation_mmpd = 20;

/// Balance of the rain of some periods, as heights of water.
struct WaterBalance {
  double rained_m = 0, ran_off_m = 0, evaporated_m = 0, drained_m = 0;
  double stored_m = 0;  ///< gain of stored water
};

/// A slice of ground and its water, as heights of water.
struct WaterSlice {
  Stratum soil;  ///< the stratum before any weather; it may reach below the slice
  SoilWater water;
  double thickness_m = 0, capacity_m = 0, water_m = 0;
  double out_m = 0;  ///< outflow in one step

  double moisture() const { return capacity_m > 0 ? water_m / capacity_m : soil.moisture; }
};

/// Water of a profile under weather.
///
/// Model   Water moves down by gravity alone, at the local conductivity (kinematic wave), through
///         slices of at most 0.1 m. At 2 m depth it drains freely. A full slice holds back the
///         water above it. Water that the surface does not absorb runs off. The uppermost slice
///         evaporates at the potential rate while it holds at least three quarters of its field
///         capacity (suction of 33 kPa). With less water, the rate falls in proportion.
/// Omits   Suction between slices, which smooths sharp wetting fronts and lifts water. Trapped air.
///         Water that stands or flows on the surface, or flows sideways.
/// Source  Smith 1983, Water Resources Research 19(3); Niswonger, Prudic and Regan 2006, USGS
///         Techniques and Methods 6-A19; evaporation: Manabe 1969, Monthly Weather Review 97(11),
///         with the 0.1 m of Allen et al. 1998, FAO Irrigation and Drainage Paper 56.
class Seepage {
 public:
  Seepage(const std::vector<SoilType>& soils, const GroundProfile& profile);

  void Run(const WeatherSpell& weather, double duration_s);
  const std::vector<WaterSlice>& slices() const { return slices_; }
  const WaterBalance& balance() const { return balance_; }
  /// The profile with present moisture and density. Adjacent slices of one stratum with similar
  /// moisture are merged. The strata below the slices stay unchanged.
  GroundProfile Profile() const;

 private:
  void Step(double rain_m, double evaporation_m, double dt_s);

  GroundProfile before_;
  std::vector<WaterSlice> slices_;
  double step_s_;
  WaterBalance balance_;
};

/// Applies periods of weather to a profile.
WaterBalance Seep(const std::vector<WeatherSpell>& weather, const std::vector<SoilType>& soils,
                  GroundProfile* profile);

/// Reads `weather_before`.
std::vector<WeatherSpell> ReadWeatherBefore(const ConfigMap& config);

/// The profile with each stratum as the soil kind nearest to its moisture.
GroundProfile OfKinds(const SoilKinds& kinds, const GroundProfile& profile);

/// Applies weather to all profiles. Adds a soil kind for each new moisture, rounded to per cent.
/// False if there is no room for one.
bool Wet(const std::vector<WeatherSpell>& weather, SoilKinds* kinds,
         std::vector<GroundProfile>* profiles);

}  // namespace tera
