#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/config/config_map.h"

namespace tera {

/// Number of faults so far in the document of `config`. Compare it before and after reading a part
/// to skip checks on values of a faulty part.
std::size_t FaultCount(const ConfigMap& config);

/// A Choice whose value determines the other keys of the mapping. If the choice is faulty, the keys
/// that the mapping lacks and its unknown keys are not reported.
std::string ChoiceOfKeys(const ConfigMap& config, std::string_view key,
                         std::initializer_list<std::string_view> allowed);
/// True if the mapping is unreadable or its ChoiceOfKeys was faulty.
bool IsUnread(const ConfigMap& config);

}  // namespace tera
