#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// Draws the values of a scenario's `randomise:` list for one episode, for keys of the scenario.
///
/// Model   entries are drawn in their order. Each has its own random stream, named "randomise/" and
///         its keys, at the episode's index. An entry thus does not depend on other entries, and
///         any episode can be drawn alone. Forms of an entry:
///         - `key` with one of `uniform: [a, b]`, `log_uniform: [a, b]`, `normal: [mean, sigma]`
///           (truncated by `within: [a, b]`), `integer: [a, b]` (both ends included), or `choice:
///           [...]` of any values, with `weights`;
///         - `together: [{key: value, ...}, ...]`: one of several sets of keys;
///         - `keys: [...]` with `mean`, `sigma` and `correlation`: normal numbers with this
///           correlation between each pair;
///         - `places: [...]`: mappings with `xy_m` and `yaw_deg`, drawn in the rectangle `x_m`,
///           `y_m` and in the range `yaw_deg`. Places are at least `apart_m` from each other and
///           `clear_m` from the points `clear_of_m`;
///         - `site`: a whole site (DrawSite), drawn after the other entries.
/// Faults  malformed entries, at their place. The reader of a key checks that it exists and that
///         its value is valid; for messages, a drawn value has the place of its entry.
std::vector<Config::GivenValue> DrawEpisode(const ConfigMap& scenario, std::uint64_t seed,
                                            std::uint64_t episode);

}  // namespace tera
