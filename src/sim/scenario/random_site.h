#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// Inputs for drawing a random site.
struct SiteDraw {
  std::uint64_t seed = 0, episode = 0;
  /// Objects already on the site: those of the scenario, and those that other entries drew.
  const ConfigMap* scenario = nullptr;
  const std::vector<Config::GivenValue>* drawn = nullptr;
};

/// Draws the ground and the objects of a construction site at random. Returns pairs of key and YAML
/// for `terrain.regions`, `terrain.pits`, `terrain.ruts`, `terrain.piles` and `obstacles`. Each
/// value is the scenario's own list followed by the drawn items.
///
/// Frames  W.
/// Model   a haul road with one bend crosses the area `x_m`, `y_m`. Then follow, in this order,
///         trenches, berms, stockpiles, rows of fence panels, and parked or scattered objects. Each
///         gets a free rectangle: at least `gap_m` from all others and from the scenario's
///         obstacles and piles, and `clear_m` from the starts of machines. Berms and fences lie
///         along the road or, with probability 1/4, across it; without a road they have any
///         heading.
///         Each object has its own random stream, "randomise/site/<kind>/<number>". A changed count
///         of one kind therefore moves another object only if both want the same place.
/// Omits   slopes under drawn obstacles, and the longer downhill foot of a pile.
/// Faults  reported at the entry: unknown keys, and objects for which no free place was found.
std::vector<std::pair<std::string, std::string>> DrawSite(const ConfigMap& entry,
                                                          const SiteDraw& draw);

}  // namespace tera
