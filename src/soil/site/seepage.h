#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/undisturbed_ground.h"
#include "soil/soil.h"

namespace tera {

/// Weather that stays the same for some hours.
struct WeatherSpell {
  double hours = 0, rain_mmph = 0, evaporation_mmpd = 0;
};

/// Where the rain of some spells has gone, as heights of water.
struct WaterBalance {
  double rained_m = 0, ran_off_m = 0, evaporated_m = 0, drained_m = 0;
  double stored_m = 0;  ///< more than before
};

/// Lets weather act on the water of a profile, whose strata come back thinner and with other
/// moisture and density.
///
/// Model   Water moves down by its weight alone, at the conductivity of where it is (kinematic
///         wave), through slices of at most 0.1 m to 2 m of depth, whence it drains freely. A full
///         slice holds up what comes from above; what the surface does not take runs off. The
///         surface's slice evaporates the potential rate while it holds three quarters of its
///         field capacity (suction of 33 kPa), below in proportion.
/// Omits   suction between slices, which wets sharper fronts' edges and lifts water; air that is
///         trapped; water that stands or flows on the surface, or sideways.
/// Source  Smith 1983, Water Resources Research 19(3); Niswonger, Prudic and Regan 2006, USGS
///         Techniques and Methods 6-A19; evaporation: Manabe 1969, Monthly Weather Review 97(11),
///         of the 0.1 m of Allen et al. 1998, FAO Irrigation and Drainage Paper 56.
WaterBalance Seep(const std::vector<WeatherSpell>& weather, const std::vector<SoilType>& soils,
                  GroundProfile* profile);

/// Reads `weather_before`.
std::vector<WeatherSpell> ReadWeatherBefore(const ConfigMap& config);

/// Lets it act on all profiles, and turns soil of other moisture than its kind's into a soil of its
/// own (AtMoisture), which it adds to `soils`. Returns false if there would be more soils than 255.
bool Wet(const std::vector<WeatherSpell>& weather, std::vector<SoilType>* soils,
         std::vector<GroundProfile>* profiles);

}  // namespace tera
