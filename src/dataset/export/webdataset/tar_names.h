#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// The file names in a complete archive of TarWriter, in order and without their folder. Nothing
/// without an archive, or for a truncated one.
std::optional<std::vector<std::string>> NamesInTar(const std::filesystem::path& archive);

}  // namespace tera
