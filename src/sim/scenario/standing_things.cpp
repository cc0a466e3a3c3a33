#include "sim/scenario/standing_things.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "core/config/config_peek.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr double kObstacle_m = 1.5;  ///< half width of an existing obstacle
constexpr double kPileFootOverHeight = 1.8;

/// Parses a line of YAML. Does not report faults, because the scenario's reader does.
std::optional<Config> Alone(const std::string& yaml) {
  try {
    return Config::FromText(yaml, "");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The position drawn for a key; the last one if there are several.
std::optional<Vec2> DrawnPlace(const std::vector<Config::GivenValue>& drawn,
                               const std::string& key) {
  for (auto value = drawn.rbegin(); value != drawn.rend(); ++value) {
    if (value->path != key) continue;
    if (const auto alone = Alone("{xy_m: " + value->yaml + "}")) {
      return alone->root().Vector2("xy_m", Any("m"), Vec2::Zero());
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Footprint> StandingThings(const ConfigMap& scenario,
                                      const std::vector<Config::GivenValue>& drawn,
                                      double clear_m) {
  std::vector<Footprint> things;
  const auto add = [&](const Vec2& middle_m, double half_m) {
    things.push_back({.middle_W_m = middle_m, .half_m = Vec2::Constant(half_m)});
  };
  const std::vector<std::string> machines = ItemsAt(scenario, {"machines"});
  for (std::size_t m = 0; m < machines.size(); ++m) {
    Vec2 at_m = Vec2::Zero();
    if (const auto alone = Alone(machines[m])) {
      if (const auto start = alone->root().OptionalMap("start")) {
        at_m = start->Vector2("xy_m", Any("m"), at_m);
      }
    }
    add(DrawnPlace(drawn, fmt::format("machines[{}].start.xy_m", m)).value_or(at_m), clear_m);
  }
  const std::vector<std::string> obstacles = ItemsAt(scenario, {"obstacles"});
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const auto alone = Alone(obstacles[o]);
    if (!alone) continue;
    const Vec2 at_m = alone->root().Vector2("xy_m", Any("m"), Vec2::Zero());
    add(DrawnPlace(drawn, fmt::format("obstacles[{}].xy_m", o)).value_or(at_m), kObstacle_m);
  }
  for (const std::string& pile : ItemsAt(scenario, {"terrain", "piles"})) {
    const auto alone = Alone(pile);
    if (!alone) continue;
    const ConfigMap root = alone->root();
    add(root.Vector2("xy_m", Any("m"), Vec2::Zero()),
        kPileFootOverHeight * root.Number("height_m", Any("m"), 0));
  }
  return things;
}

}  // namespace tera
