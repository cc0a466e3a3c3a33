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

/// A site before any change, from the scenario's `terrain:` mapping. It is constant, so that any
/// number of runs can start on it, also in parallel. Each run changes its own Soil (MakeSoil).
///
/// Frames  W.
class Site {
 public:
  /// Reads size, cell, soils, relief or GeoTIFF, strips, piles and pits. Faults go to `config`.
  /// `seed` drives the relief. `given` replaces a GeoTIFF.
  static Site Read(const ConfigMap& config, std::uint64_t seed,
                   const std::optional<GivenGround>& given = std::nullopt);

  /// Raises undisturbed ground. Call it before machines are placed.
  void Raise(const RaisedGround& raised) { columns_.Raise(raised); }

  /// Enables rain and evaporation during runs, at the rates of `weather`. `is_wet` means that it
  /// has already rained on the surface. False if this needs more soil kinds than possible. Call it
  /// when the ground is complete.
  bool LetWeatherAct(const WeatherSpell& weather, bool is_wet);
  /// True if the scenario gives weather before the start.
  bool has_weather_before() const { return has_weather_before_; }
  /// State at the start of a run; empty without weather.
  const std::optional<GroundWeather>& weather() const { return weather_; }

  const Columns& columns() const { return columns_; }
  const TerrainSurface& surface() const { return columns_.surface(); }
  /// The visible soils, as Cover::soil indexes them.
  const std::vector<SoilType>& soils() const { return soils_; }
  /// Geodetic position of the origin of W, if a GeoTIFF gives it.
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
