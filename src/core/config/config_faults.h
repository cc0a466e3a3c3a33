#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/config/config_map.h"

namespace tera {

/// Number of faults so far in the whole configuration of `config`. Callers use it to skip checks of
/// values from a faulty part.
std::size_t FaultCount(const ConfigMap& config);

/// A Choice that determines which other keys the mapping has. After a fault, missing and surplus
/// keys of the mapping are not reported.
std::string ChoiceOfKeys(const ConfigMap& config, std::string_view key,
                         std::initializer_list<std::string_view> allowed);
/// True after such a fault, or if the mapping is unreadable.
bool IsUnread(const ConfigMap& config);

}  // namespace tera
