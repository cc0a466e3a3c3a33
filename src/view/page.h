#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// Placeholder in the page for embedded data.
inline constexpr std::string_view kPackMark = "<!--pack-->";

/// Possible locations of the built page: the installed data and the build folder.
std::vector<std::filesystem::path> PagePlaces();

/// Reads the first page that exists. If there is none, throws InputError that names what the build
/// lacks.
std::string ReadPage(const std::vector<std::filesystem::path>& places);

}  // namespace tera
