#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// The file that `key` names, as of ConfigMap::File, or the files of a list. A folder that lists
/// its files in one of the name `list`, as a recorder's does, may be named in place of that one.
/// None where one of them is not there, which is a fault.
std::vector<std::filesystem::path> FilesOrList(const ConfigMap& config, std::string_view key,
                                               const std::string& list);

/// The folder that `key` names, as ConfigMap::File has files.
std::filesystem::path Folder(const ConfigMap& config, std::string_view key);

}  // namespace tera
