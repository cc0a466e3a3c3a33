#pragma once

#include <string>
#include <string_view>

#include "core/config/config_map.h"

/// Rules for names that become parts of file paths and CSV headers.

namespace tera {

/// True for 1 to kLongestName characters out of ASCII letters, digits, '_' and '-'.
bool IsPlainName(std::string_view name);

/// As IsPlainName, but dots are allowed inside the name, as in URDF names.
bool IsPlainNameWithPoints(std::string_view name);

/// Replaces each character that IsPlainNameWithPoints forbids by '_'.
std::string MadePlain(std::string_view name);

/// Leaves room for suffixes within the 255 bytes of common file systems.
inline constexpr std::size_t kLongestName = 100;

/// Returns whether `name` is plain. If not, reports a fault at `key` of `config`, or at the mapping
/// if `key` is empty. An empty text at `key` adds no fault, because its reader has already reported
/// it.
bool RequirePlainName(const ConfigMap& config, std::string_view key, const std::string& name);

}  // namespace tera
