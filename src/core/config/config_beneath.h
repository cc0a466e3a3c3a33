#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// A number that a non-YAML file defines for a key. `path` is the list of nested keys.
struct GivenNumber {
  std::vector<std::string> path;
  double value = 0;
};

/// Adds numbers of `file` as the lowest layer of the mapping. One key of the mapping names this
/// file. The resolved document does not store these numbers; its reader reads the file again.
void LayBeneath(const ConfigMap& config, const std::string& file,
                const std::vector<GivenNumber>& numbers);

/// True if both keys exist and every layer with `key` is below the layers with `upper`. The caller
/// then uses `upper` instead and does not read `key`, so the resolved document omits `key`.
bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

}  // namespace tera
