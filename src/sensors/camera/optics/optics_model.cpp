#include "sensors/camera/optics/optics_model.h"

#include <fmt/format.h>

namespace tera {
namespace {

constexpr double kMostPieces = 2000;

GlareModel ReadGlare(const ConfigMap& config) {
  GlareModel m;
  m.scattered = config.Number("scattered", Between(0, 0.5, "1"), m.scattered);
  m.core_deg = config.Number("core_deg", Between(0.01, 20, "deg"), m.core_deg);
  m.slope = config.Number("slope", Between(1, 6, "1"), m.slope);
  return m;
}

FlareModel ReadFlare(const ConfigMap& config) {
  FlareModel m;
  m.ghosts = static_cast<int>(config.Integer("ghosts", Between(1, 100, ""), m.ghosts));
  m.reflectance = config.Number("reflectance", Between(0, 0.2, "1"), m.reflectance);
  return m;
}

SoilingModel ReadSoiling(const ConfigMap& config) {
  SoilingModel m;
  m.distance_mm = config.Number("distance_mm", Between(0.5, 1000, "mm"), m.distance_mm);
  m.film = config.Number("film", Between(0, 0.9, "1"), m.film);
  m.specks = static_cast<int>(config.Integer("specks", Between(0, kMostPieces, ""), m.specks));
  m.speck_mm = config.Number("speck_mm", Between(0.01, 50, "mm"), m.speck_mm);
  m.drops = static_cast<int>(config.Integer("drops", Between(0, kMostPieces, ""), m.drops));
  m.drop_mm = config.Number("drop_mm", Between(0.1, 20, "mm"), m.drop_mm);
  if (m.film == 0 && m.specks == 0 && m.drops == 0) {
    config.Fault("",
                 "without film, specks and drops the glass is clean; need one of them above 0, "
                 "or no soiling");
  }
  return m;
}

}  // namespace

OpticsModel ReadOptics(const ConfigMap& config) {
  OpticsModel m;
  m.focus_m = config.OptionalNumber("focus_m", Between(0.05, 1e6, "m"));
  if (const auto glare = config.OptionalMap("glare")) m.glare = ReadGlare(*glare);
  if (const auto flare = config.OptionalMap("flare")) m.flare = ReadFlare(*flare);
  if (const auto soiling = config.OptionalMap("soiling")) m.soiling = ReadSoiling(*soiling);
  if (!m.focus_m && !m.glare && !m.flare && !m.soiling) {
    config.Fault("", "is empty; need some of focus_m, glare, flare and soiling, or no optics");
  }
  return m;
}

std::string OpticsYaml(const OpticsModel& m) {
  std::string text;
  if (m.focus_m) text += fmt::format("    focus_m: {}\n", *m.focus_m);
  if (m.glare) {
    text += fmt::format("    glare:\n      scattered: {}\n      core_deg: {}\n      slope: {}\n",
                        m.glare->scattered, m.glare->core_deg, m.glare->slope);
  }
  if (m.flare) {
    text += fmt::format("    flare:\n      ghosts: {}\n      reflectance: {}\n", m.flare->ghosts,
                        m.flare->reflectance);
  }
  if (m.soiling) {
    text += fmt::format(
        "    soiling:\n      distance_mm: {}\n      film: {}\n      specks: {}\n      speck_mm: "
        "{}\n"
        "      drops: {}\n      drop_mm: {}\n",
        m.soiling->distance_mm, m.soiling->film, m.soiling->specks, m.soiling->speck_mm,
        m.soiling->drops, m.soiling->drop_mm);
  }
  return text;
}

}  // namespace tera
