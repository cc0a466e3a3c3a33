#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config/input_file.h"

namespace tera {

/// "tera:..." for a file that TERA ships, identical on every computer; otherwise the absolute path
/// with resolved folder links. A link to a file keeps its own name, because the file's references
/// are relative to the link.
std::string PortableName(const std::filesystem::path& path);

/// Location of the file with that portable name. The first applicable entry of `moved` wins.
std::filesystem::path PlaceOfInput(const std::string& name, const std::vector<MovedFiles>& moved);

/// True if the name is `moved.from` or below it.
bool Concerns(const MovedFiles& moved, const std::string& name);

}  // namespace tera
