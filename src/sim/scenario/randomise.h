#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// What a scenario's `randomise:` draws for one episode, as values for keys of the scenario.
///
/// Model   one entry of the list after the other, each from its own stream, "randomise/" and its
///         keys, at the episode's index: an entry draws the same whatever stands beside it, and any
///         episode can be drawn alone. `key` with one of `uniform: [a, b]`, `log_uniform: [a, b]`,
///         `normal: [mean, sigma]` (cut by `within: [a, b]`), `integer: [a, b]` with both ends, and
///         `choice: [...]` of any values with `weights`; `together: [{key: value, ...}, ...]`
///         draws one of several sets of keys; `keys: [...]` with `mean`, `sigma` and
///         `correlation` draws normal numbers, each two of them correlated so; `places: [...]` of
///         mappings with `xy_m` and `yaw_deg`, in the rectangle `x_m`, `y_m` at headings `yaw_deg`,
///         at least `apart_m` from each other and `clear_m` from the points `clear_of_m`; `site` is
///         a whole site (DrawSite), behind what other entries drew.
/// Faults  what is no such entry, at its place. That a key is there and admits a value is up to
///         whoever reads it; each value has the place of its entry.
std::vector<Config::GivenValue> DrawEpisode(const ConfigMap& scenario, std::uint64_t seed,
                                            std::uint64_t episode);

}  // namespace tera
