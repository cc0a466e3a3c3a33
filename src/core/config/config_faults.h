#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/config/config_map.h"

namespace tera {

/// How many faults the whole configuration of `config` has so far, for checks of what was read
/// without any: what is made of a faulty part is no fault of its own.
std::size_t FaultCount(const ConfigMap& config);

/// A Choice that says which further keys the mapping has. After a fault nothing more is reported of
/// what the mapping lacks or has too much.
std::string ChoiceOfKeys(const ConfigMap& config, std::string_view key,
                         std::initializer_list<std::string_view> allowed);
/// That was so, or the mapping could not be read at all.
bool IsUnread(const ConfigMap& config);

}  // namespace tera
