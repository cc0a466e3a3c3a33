#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/config/config_map.h"

namespace tera {

/// The file that `key` names, as of ConfigMap::File. A folder that lists its files in one of the
/// name `list`, as a recorder's does, may be named in place of that one.
std::filesystem::path FileOrList(const ConfigMap& config, std::string_view key,
                                 const std::string& list);

/// The folder that `key` names, as ConfigMap::File has files.
std::filesystem::path Folder(const ConfigMap& config, std::string_view key);

}  // namespace tera
