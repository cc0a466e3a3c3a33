#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

/// Looking at what a configuration has without reading it: the resolved document and its order stay
/// as they are, and no key counts as known.

namespace tera {

/// Whether a mapping at `key` of `config` has `inner`, in any layer.
bool HasBelow(const ConfigMap& config, std::string_view key, std::string_view inner);

/// The items of the list at `path`, keys of nested mappings, each as YAML on one line: those of the
/// first layer that has a list there; none where none has.
std::vector<std::string> ItemsAt(const ConfigMap& config, const std::vector<std::string>& path);

}  // namespace tera
