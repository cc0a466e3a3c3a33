#pragma once

#include <string>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// A number that another file than YAML gives, at the keys of `path`.
struct GivenNumber {
  std::vector<std::string> path;
  double value = 0;
};

/// Puts numbers of `file`, which the mapping names under one of its keys, below all layers of the
/// mapping. Whoever reads the resolved document reads that file again.
void LayBeneath(const ConfigMap& config, const std::string& file,
                const std::vector<GivenNumber>& numbers);

}  // namespace tera
