#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

/// Queries on a configuration that do not count as reading it. They do not change the resolved
/// document. A key that only a query mentions is still reported as unknown.

namespace tera {

/// True if, in any layer, `config` has a mapping at `key` that has the key `inner`.
bool HasBelow(const ConfigMap& config, std::string_view key, std::string_view inner);

/// Items of the list at a path of nested keys, each as one line of YAML. The items come from the
/// first layer that has a list there; the result is empty if no layer has one.
std::vector<std::string> ItemsAt(const ConfigMap& config, const std::vector<std::string>& path);

}  // namespace tera
