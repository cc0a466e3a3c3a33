#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_map.h"

namespace tera {

/// The files that `key` names: a single file or a list of files. A single path may also be a folder
/// that contains a file called `list`; the result is then that file. Recording programs write such
/// list files. An absent file is a fault and gives an empty result. Paths resolve as in
/// ConfigMap::File.
std::vector<std::filesystem::path> FilesOrList(const ConfigMap& config, std::string_view key,
                                               const std::string& list);

/// The folder that `key` names; paths resolve as in ConfigMap::File.
std::filesystem::path Folder(const ConfigMap& config, std::string_view key);

}  // namespace tera
