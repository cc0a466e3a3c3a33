#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// A number from a file other than YAML, at the keys of `path`.
struct GivenNumber {
  std::vector<std::string> path;
  double value = 0;
};

/// Lays numbers of `file` below all layers of the mapping, which names the file under one of its
/// keys. A reader of the resolved document reads that file again.
void LayBeneath(const ConfigMap& config, const std::string& file,
                const std::vector<GivenNumber>& numbers);

/// True if both keys exist and `key` occurs only in layers below `upper`, as in a preset below the
/// file's own value. A caller that lets `upper` replace `key` does not read `key`, so the resolved
/// document omits it.
bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

}  // namespace tera
