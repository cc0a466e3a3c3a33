#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config/input_file.h"

namespace tera {

/// "tera:..." for a file that TERA ships, which has that name on every machine; else its absolute
/// path, without links to folders. A link that is the file itself keeps its name, since files that
/// it names are looked for beside the link.
std::string PortableName(const std::filesystem::path& path);

/// Where the file of that portable name is read. The first of `moved` that concerns it holds.
std::filesystem::path PlaceOfInput(const std::string& name, const std::vector<MovedFiles>& moved);

/// Whether the name is `moved.from` or below it.
bool Concerns(const MovedFiles& moved, const std::string& name);

}  // namespace tera
