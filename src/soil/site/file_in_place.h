#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace tera {

/// A file under its own name only when it is whole: `write` writes it under a temporary one, and
/// says why where it could not. Throws InputError.
void PutInPlace(
    const std::filesystem::path& file,
    const std::function<std::optional<std::string>(const std::filesystem::path& part)>& write);

}  // namespace tera
