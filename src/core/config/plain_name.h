#pragma once

#include <string>
#include <string_view>

#include "core/config/config_map.h"

/// Names that stand in paths and in headers of CSV files.

namespace tera {

/// ASCII letters, digits, '_' and '-', at least one and at most kLongestName of them.
bool IsPlainName(std::string_view name);

/// A plain name that may have points inside, as names in a URDF do.
bool IsPlainNameWithPoints(std::string_view name);

/// The name with one '_' for each sign that a plain name with points cannot have.
std::string MadePlain(std::string_view name);

/// Well below what file systems take, with the endings that names get.
inline constexpr std::size_t kLongestName = 100;

/// Reports a name that is not plain at `key` of `config`, or at the mapping where `key` is empty,
/// and returns whether it was plain. Where the text at `key` is empty, its reader has reported it.
bool RequirePlainName(const ConfigMap& config, std::string_view key, const std::string& name);

}  // namespace tera
