#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tera {

/// File names in an archive of TarWriter, in order and without folders. Returns nullopt if the
/// archive is absent or truncated.
std::optional<std::vector<std::string>> NamesInTar(const std::filesystem::path& archive);

}  // namespace tera
