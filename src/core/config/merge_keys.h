#pragma once

#include <yaml-cpp/yaml.h>

namespace tera::internal {

/// Puts into each mapping below `node` what its key `<<` names, a mapping or a list of them, as
/// YAML 1.1's merge key asks: what the mapping says itself comes first, then the earlier of a list.
/// Throws YAML::Exception, with its place, where `<<` has something else.
void ApplyMergeKeys(const YAML::Node& node);

}  // namespace tera::internal
