#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// The file that `key` names (see ConfigMap::File), or the files of a list. `key` may also name a
/// folder that contains `list`, a file that lists the folder's files, as recorders write it. An
/// absent file is a fault; the result is then empty.
std::vector<std::filesystem::path> FilesOrList(const ConfigMap& config, std::string_view key,
                                               const std::string& list);

/// The folder that `key` names; paths resolve as in ConfigMap::File.
std::filesystem::path Folder(const ConfigMap& config, std::string_view key);

}  // namespace tera
