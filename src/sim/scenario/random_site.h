#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// What a site is drawn from.
struct SiteDraw {
  std::uint64_t seed = 0, episode = 0;
  /// What stands there already: the scenario as it is written, and what other entries drew before.
  const ConfigMap* scenario = nullptr;
  const std::vector<Config::GivenValue>* drawn = nullptr;
};

/// The ground and the things of a building site, drawn at random: values for `terrain.regions`,
/// `terrain.pits`, `terrain.ruts`, `terrain.piles` and `obstacles`, each the scenario's own list
/// and behind it what is drawn, as pairs of key and YAML.
///
/// Frames  W.
/// Model   A haul road crosses the area `x_m`, `y_m` with one bend; trenches, berms, stockpiles,
///         runs of fence panels, and parked or strewn things follow, one after the other, each as
///         the rectangle that it takes up, at a place where it keeps `gap_m` from all others, from
///         the obstacles and piles that the scenario has, and `clear_m` from where machines start.
///         Each has its own stream, "randomise/site/<kind>/<number>", so that how many of one kind
///         there are moves another only where both want one place. Berms and fences run along
///         the road, if there is one, or across it.
/// Omits   that a drawn obstacle stands on a slope, that a pile's foot reaches further downhill.
/// Faults  at the entry: what is no such key, and where no free place is found.
std::vector<std::pair<std::string, std::string>> DrawSite(const ConfigMap& entry,
                                                          const SiteDraw& draw);

}  // namespace tera
