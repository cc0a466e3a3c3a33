#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// The names of the files in a whole archive of TarWriter, in their order and without their folder.
/// Nothing where there is no archive, or where it was cut off.
std::optional<std::vector<std::string>> NamesInTar(const std::filesystem::path& archive);

}  // namespace tera
