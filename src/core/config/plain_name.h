#pragma once

#include <string>
#include <string_view>

#include "core/config/config_map.h"

/// Names that occur in paths and in CSV headers.

namespace tera {

/// True for 1 to kLongestName ASCII letters, digits, '_' and '-'.
bool IsPlainName(std::string_view name);

/// True for a plain name that may contain inner points, as in a URDF.
bool IsPlainNameWithPoints(std::string_view name);

/// Replaces each character that a plain name with points cannot contain by '_'.
std::string MadePlain(std::string_view name);

/// Well below file system limits, including the suffixes of names.
inline constexpr std::size_t kLongestName = 100;

/// Returns whether `name` is plain and otherwise reports a fault at `key` of `config`. An empty
/// `key` reports at the mapping. If the text at `key` is empty, its reader has already reported it.
bool RequirePlainName(const ConfigMap& config, std::string_view key, const std::string& name);

}  // namespace tera
