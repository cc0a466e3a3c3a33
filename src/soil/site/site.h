#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/config/config.h"
#include "soil/columns/columns.h"
#include "soil/site/given_ground.h"
#include "soil/site/ground_weather.h"
#include "soil/soil.h"

namespace tera {

/// A site before anything has moved on it, by the scenario's `terrain:` mapping. It is constant, so
/// that any number of runs may start on it, also at the same time. Each run works a Soil of its own
/// (MakeSoil).
///
/// Frames  W.
class Site {
 public:
  /// Reads the mapping: size, cell, soils, relief or GeoTIFF, strips, piles, pits. Faults go to
  /// `config`. `seed` feeds the relief's streams. `given` stands in the place of a GeoTIFF.
  static Site Read(const ConfigMap& config, std::uint64_t seed,
                   const std::optional<GivenGround>& given = std::nullopt);

  /// Raises undisturbed ground, before machines are placed on it.
  void Raise(const RaisedGround& raised) { columns_.Raise(raised); }

  /// Lets rain and evaporation act during runs, at the rates of `weather`; the surface `is_wet`
  /// from the start if it has rained already. Returns false if that needs more kinds of soil than
  /// there may be. Call when the ground is as runs start on it.
  bool LetWeatherAct(const WeatherSpell& weather, bool is_wet);
  /// Whether the scenario gives the weather until the start.
  bool has_weather_before() const { return has_weather_before_; }
  /// At the start of a run; nothing where no weather acts.
  const std::optional<GroundWeather>& weather() const { return weather_; }

  const Columns& columns() const { return columns_; }
  const TerrainSurface& surface() const { return columns_.surface(); }
  /// The soils that are shown, as an index of Cover::soil.
  const std::vector<SoilType>& soils() const { return soils_; }
  /// Place of W's origin, where a GeoTIFF says it.
  const std::optional<SiteOrigin>& georeference() const { return georeference_; }

 private:
  Site(Columns columns, std::optional<SiteOrigin> georeference, bool has_weather_before)
      : columns_(std::move(columns)),
        soils_(columns_.soils()),
        georeference_(georeference),
        has_weather_before_(has_weather_before) {}

  Columns columns_;
  std::vector<SoilType> soils_;
  std::optional<GroundWeather> weather_;
  std::optional<SiteOrigin> georeference_;
  bool has_weather_before_;
};

}  // namespace tera
