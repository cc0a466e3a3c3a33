#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config.h"

namespace tera {

/// Values that a scenario's `randomise:` draws for one episode, for keys of the scenario.
///
/// Model   draws the entries of the list in order, each from its own stream, "randomise/" and its
///         keys, at the episode's index. An entry thus does not depend on other entries, and any
///         episode can be drawn alone. Forms of an entry:
///         - `key` with one of `uniform: [a, b]`, `log_uniform: [a, b]`, `normal: [mean, sigma]`
///           (cut by `within: [a, b]`), `integer: [a, b]` with both ends, and `choice: [...]` of
///           any values with `weights`;
///         - `together: [{key: value, ...}, ...]`, one of several sets of keys;
///         - `keys: [...]` with `mean`, `sigma` and `correlation`, normal numbers with this
///           correlation between each two;
///         - `places: [...]` of mappings with `xy_m` and `yaw_deg`, in the rectangle `x_m`, `y_m`
///           at headings `yaw_deg`, at least `apart_m` from each other and `clear_m` from the
///           points `clear_of_m`;
///         - `site`, a whole site (DrawSite), after the draws of other entries.
/// Faults  malformed entries, at their place. The reader of a key checks its existence and value;
///         each value has the place of its entry.
std::vector<Config::GivenValue> DrawEpisode(const ConfigMap& scenario, std::uint64_t seed,
                                            std::uint64_t episode);

}  // namespace tera
