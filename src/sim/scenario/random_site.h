#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// Inputs of a random site.
struct SiteDraw {
  std::uint64_t seed = 0, episode = 0;
  /// Existing things: the scenario as written, and the draws of other entries.
  const ConfigMap* scenario = nullptr;
  const std::vector<Config::GivenValue>* drawn = nullptr;
};

/// The ground and the things of a building site, drawn at random. Returns pairs of key and YAML for
/// `terrain.regions`, `terrain.pits`, `terrain.ruts`, `terrain.piles` and `obstacles`. Each value
/// is the scenario's own list followed by the drawn items.
///
/// Frames  W.
/// Model   A haul road crosses the area `x_m`, `y_m` with one bend. Trenches, berms, stockpiles,
///         runs of fence panels, and parked or scattered things follow in this order. Each occupies
///         a rectangle at a free place: `gap_m` from all others and from the scenario's obstacles
///         and piles, and `clear_m` from machine starts. Each has its own stream,
///         "randomise/site/<kind>/<number>", so the count of one kind moves another only if both
///         want the same place. Berms and fences run along the road, if there is one, or across it.
/// Omits   slopes under drawn obstacles, and the longer downhill foot of a pile.
/// Faults  at the entry: unknown keys, and things without a free place.
std::vector<std::pair<std::string, std::string>> DrawSite(const ConfigMap& entry,
                                                          const SiteDraw& draw);

}  // namespace tera
