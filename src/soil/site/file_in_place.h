#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace tera {

/// Writes a file atomically. `write` receives a temporary path and returns a reason if it fails. On
/// success the file is renamed to `file`. Throws InputError.
void PutInPlace(
    const std::filesystem::path& file,
    const std::function<std::optional<std::string>(const std::filesystem::path& part)>& write);

}  // namespace tera
