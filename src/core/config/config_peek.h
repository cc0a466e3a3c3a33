#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

/// Inspects a configuration without reading it: the resolved document does not change, and no key
/// becomes known.

namespace tera {

/// True if a mapping at `key` of `config` has the key `inner`, in any layer.
bool HasBelow(const ConfigMap& config, std::string_view key, std::string_view inner);

/// Items of the list at `path`, a path of nested keys, each as YAML on one line. The first layer
/// with a list there supplies them; empty if no layer has a list.
std::vector<std::string> ItemsAt(const ConfigMap& config, const std::vector<std::string>& path);

}  // namespace tera
