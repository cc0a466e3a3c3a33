#pragma once

#include <string>
#include <string_view>
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

/// Both are there, and `key` in a lower layer alone than `upper`, as a preset's below what a file
/// says itself. Who lets `upper` replace it does not read it: the resolved document is without.
bool LiesBelow(const ConfigMap& config, std::string_view key, std::string_view upper);

}  // namespace tera
