#include "sim/scenario/read_light.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/config/spelling.h"
#include "core/units.h"
#include "core/utc_time.h"
#include "sim/scenario/read_weather.h"
#include "sim/scenario/sun.h"

namespace tera {
namespace {

constexpr double kLowSun_deg = 2;  ///< the sky model is not valid below it
constexpr double kLampLight_klx = 0.03;
constexpr double kSunAzimuth_deg = 150, kSunElevation_deg = 42;  ///< default sun: a clear morning

Vec3 ReadToSun(const ConfigMap& config) {
  const double azimuth_rad =
      config.Number("sun_azimuth_deg", Between(-360, 360, "deg"), kSunAzimuth_deg) *
      kDeg;  // clockwise from north
  const double elevation_rad =
      config.Number("sun_elevation_deg", Between(1, 90, "deg"), kSunElevation_deg) * kDeg;
  return {std::sin(azimuth_rad) * std::cos(elevation_rad),
          std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad)};
}

/// Exposure value that a light meter on level ground gives, but at least that for the lamps of a
/// site.
double MeteredEv100(const Environment& environment) {
  const double sin_height = std::max(environment.to_sun_W.z(), 0.0);
  const double sky_klx = ClearSkyIlluminance_lx(std::asin(environment.to_sun_W.z())) / 1000;
  const double cover = environment.cloud_cover.value_or(0);
  const double level_klx = environment.sun_illuminance_klx * sin_height + sky_klx;
  const double left = 1 - 0.75 * std::pow(cover, 3.4);
  return Ev100OfIlluminance(std::max(left * level_klx, kLampLight_klx));
}

/// Sets the sun's position and light for a time. Also sets the sky's light where the sun's
/// elevation is too low for the sky model.
void SetDaylight(const ConfigMap& config, const SiteOrigin& origin, Environment* environment) {
  const std::string text = config.Text("time");
  for (const char* key : {"sun_azimuth_deg", "sun_elevation_deg"}) {
    if (config.Has(key)) config.Fault(key, "given beside time, which determines it; keep one");
  }
  const std::optional<TimeNs> utc_ns = ParseUtc(text);
  if (!utc_ns) {
    config.Fault("time", {FaultKind::kMistyped, "'" + text +
                                                    "' is no time; need UTC from 1970 to 2037, "
                                                    "2026-06-21T09:30:00Z"});
    return;
  }
  environment->to_sun_W = ToSun(*utc_ns, origin);
  const double sin_height = environment->to_sun_W.z();
  environment->sun_illuminance_klx = ClearSunIlluminance_klx(sin_height);
  if (std::asin(sin_height) < kLowSun_deg * kDeg) {
    environment->sky_illuminance_lx = ClearSkyIlluminance_lx(std::asin(sin_height));
  }
}

ScenarioLamp ReadLamp(const ConfigMap& config, const MachineOfName& machine_of) {
  constexpr double kNarrowest_deg = 1, kWidest_deg = 150, kBrightest_lm = 1e7;
  ScenarioLamp lamp;
  lamp.machine = config.Text("machine", "");
  lamp.X_PL = config.PoseXyzRpy();
  lamp.flux_lm = config.Number("flux_lm", Between(0, kBrightest_lm, "lm"));
  lamp.half_angle_rad =
      0.5 * config.Number("beam_deg", Between(kNarrowest_deg, kWidest_deg, "deg")) * kDeg;
  if (lamp.machine.empty()) return lamp;
  lamp.link = config.Text("link");
  const MachineModel* machine = machine_of(lamp.machine);
  if (machine == nullptr) {
    config.Fault("machine", {FaultKind::kNoSuchName,
                             "'" + lamp.machine + "' is not a machine of this scenario"});
    return lamp;
  }
  std::vector<std::string> links;
  for (const Link& link : machine->links) links.push_back(link.name);
  if (!lamp.link.empty() && std::ranges::count(links, lamp.link) == 0) {
    config.Fault("link",
                 {FaultKind::kNoSuchName,
                  fmt::format("'{}' is not a link of {}{}; need one of {}", lamp.link, lamp.machine,
                              DidYouMean(lamp.link, links), fmt::join(links, ", "))});
  }
  return lamp;
}

}  // namespace

Environment ReadEnvironment(const ConfigMap& config, const SiteOrigin& origin) {
  Environment environment;
  const bool is_timed = config.Has("time");
  if (is_timed) {
    SetDaylight(config, origin, &environment);
  } else {
    environment.to_sun_W = ReadToSun(config);
  }
  environment.sun_illuminance_klx =
      config.Number("sun_illuminance_klx", AtLeast(0, "klx"), environment.sun_illuminance_klx);
  if (is_timed && environment.to_sun_W.z() <= 0 && environment.sun_illuminance_klx > 0) {
    config.Fault("sun_illuminance_klx", "the sun is below the horizon at that time; remove it");
  }
  environment.turbidity = config.Number("turbidity", Between(1.5, 10, ""), environment.turbidity);
  // Read as optional, so that the resolved scenario contains no default visibility. As an explicit
  // value it would be read back as fog.
  if (const auto visibility_m = config.OptionalNumber("visibility_m", Positive("m"))) {
    environment.fog_visibility_m = environment.weather.visibility_m = *visibility_m;
  }
  environment.cloud_cover = config.OptionalNumber("cloud_cover", Between(0, 1, ""));
  const double metered_ev100 = is_timed ? MeteredEv100(environment) : environment.exposure_ev100;
  environment.exposure_ev100 =
      config.Number("exposure_ev100", Between(-5, 25, "EV"), metered_ev100);
  ReadWeather(config, &environment);
  return environment;
}

std::vector<ScenarioLamp> ReadLamps(const ConfigMap& config, const MachineOfName& machine_of) {
  std::vector<ScenarioLamp> lamps;
  for (const ConfigMap& lamp : config.List("lamps")) lamps.push_back(ReadLamp(lamp, machine_of));
  if (lamps.size() > kMostLamps) {
    config.Fault("lamps", {FaultKind::kOutOfRange,
                           fmt::format("{} lamps; need at most {}", lamps.size(), kMostLamps)});
  }
  return lamps;
}

}  // namespace tera
