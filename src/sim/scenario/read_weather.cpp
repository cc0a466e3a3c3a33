#include "sim/scenario/read_weather.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/units.h"
#include "render/air/rain.h"
#include "soil/site/seepage.h"

namespace tera {
namespace {

constexpr double kMostWind_mps = 40, kMostSnowfall_mmph = 20;
constexpr double kMostWater_m = 0.5, kMostSnow_m = 0.5;
constexpr double kMostCells = 4e6;
constexpr double kLeastCloud = 0.5;  ///< smallest cloud cover if it rains
constexpr double kWarmestSnow_degc = 5, kColdestRain_degc = -10;

DustModel ReadDust(const ConfigMap& config) {
  DustModel dust;
  dust.emission_factor =
      config.Number("emission_factor", Between(0, 1000, ""), dust.emission_factor);
  dust.silt_percent = config.Number("silt_percent", Between(0.1, 50, "%"), dust.silt_percent);
  dust.extent_m = config.Number("extent_m", Between(10, 400, "m"), dust.extent_m);
  dust.height_m = config.Number("height_m", Between(2, 50, "m"), dust.height_m);
  dust.cell_m = config.Number("cell_m", Between(0.1, 2, "m"), dust.cell_m);
  const double cells = dust.extent_m * dust.extent_m * dust.height_m / std::pow(dust.cell_m, 3);
  if (cells > kMostCells) {
    config.Fault("cell_m", {FaultKind::kOutOfRange,
                            fmt::format("{} m makes {:.2g} cells of {} x {} x {} m of air; need at "
                                        "most {:.0g}, so larger cells or less air",
                                        dust.cell_m, cells, dust.extent_m, dust.extent_m,
                                        dust.height_m, kMostCells)});
  }
  return dust;
}

void CheckTemperature(const ConfigMap& config, const Weather& weather) {
  const std::optional<double> degc =
      config.OptionalNumber("temperature_degc", Between(-60, 60, "C"));
  if (!degc) return;
  if (weather.snowfall_mmph > 0 && *degc > kWarmestSnow_degc) {
    config.Fault("snowfall_mmph", {FaultKind::kOutOfRange,
                                   fmt::format("snow falls at {} C; need at most {} C, or no snow",
                                               *degc, kWarmestSnow_degc)});
  }
  if (weather.snow_depth_m > 0 && *degc > kWarmestSnow_degc) {
    config.Fault("snow_depth_m", {FaultKind::kOutOfRange,
                                  fmt::format("snow lies on the ground at {} C; need at most {} C, "
                                              "or no snow",
                                              *degc, kWarmestSnow_degc)});
  }
  if (weather.rain_mmph > 0 && *degc < kColdestRain_degc) {
    config.Fault("rain_mmph", {FaultKind::kOutOfRange,
                               fmt::format("rain falls at {} C; need at least {} C, or no rain",
                                           *degc, kColdestRain_degc)});
  }
}

void CheckSky(const ConfigMap& config, const Environment& environment) {
  const double cover = environment.cloud_cover.value_or(0);
  if (cover >= kLeastCloud) return;
  const auto check = [&](const char* key, const char* what, double rate_mmph) {
    if (rate_mmph <= 0) return;
    config.Fault(
        key, fmt::format("{0} falls from {1}; need cloud_cover of at least {2}, or no {0}", what,
                         environment.cloud_cover
                             ? fmt::format("a sky with cloud_cover {}", cover)
                             : std::string("a sky without cloud_cover, which is clear"),
                         kLeastCloud));
  };
  check("rain_mmph", "rain", environment.weather.rain_mmph);
  check("snowfall_mmph", "snow", environment.weather.snowfall_mmph);
}

/// Visibility through fog and precipitation together: extinctions add.
double VisibilityTogether_m(double visibility_m, const Weather& weather) {
  const double falling_1pm =
      Rain(weather.rain_mmph).Extinction_1pm() + Snowfall(weather.snowfall_mmph).Extinction_1pm();
  const double one_m = -std::log(kVisibleContrast);
  return one_m / (one_m / visibility_m + falling_1pm);
}

}  // namespace

void ReadWeather(const ConfigMap& config, Environment* environment) {
  Weather& weather = environment->weather;
  const auto number = [&](const char* key, const Range& range) {
    return config.OptionalNumber(key, range).value_or(0);
  };
  weather.wind.speed_mps = number("wind_mps", Between(0, kMostWind_mps, "m/s"));
  weather.wind.from_rad = number("wind_from_deg", Between(-360, 360, "deg")) * kDeg;
  weather.rain_mmph = number("rain_mmph", Between(0, kMostRain_mmph, "mm/h"));
  weather.snowfall_mmph = number("snowfall_mmph", Between(0, kMostSnowfall_mmph, "mm/h"));
  weather.puddle_depth_m = number("puddle_depth_m", Between(0, kMostWater_m, "m"));
  weather.snow_depth_m = number("snow_depth_m", Between(0, kMostSnow_m, "m"));
  if (const auto dust = config.OptionalMap("dust")) weather.dust = ReadDust(*dust);
  CheckTemperature(config, weather);
  CheckSky(config, *environment);
  if (weather.rain_mmph > 0 || weather.snowfall_mmph > 0) {
    environment->fog_visibility_m = VisibilityTogether_m(environment->fog_visibility_m, weather);
  }
}

}  // namespace tera
