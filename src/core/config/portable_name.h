#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config/input_file.h"

namespace tera {

/// A file name that is valid on other computers where possible. A file shipped with TERA is named
/// "tera:...". Any other file has an absolute path in which links to folders are resolved. A link
/// to a file is not resolved, because paths inside the file are relative to the link.
std::string PortableName(const std::filesystem::path& path);

/// Location of the file with the given portable name. If several entries of `moved` apply, the
/// first wins.
std::filesystem::path PlaceOfInput(const std::string& name, const std::vector<MovedFiles>& moved);

/// True if `name` is `moved.from` or a path below it.
bool Concerns(const MovedFiles& moved, const std::string& name);

}  // namespace tera
