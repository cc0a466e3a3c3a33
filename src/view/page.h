#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// Placeholder for embedded data in the page.
inline constexpr std::string_view kPackMark = "<!--pack-->";

/// Candidate locations of the built page: the installed data and this build's folder.
std::vector<std::filesystem::path> PagePlaces();

/// Reads the first existing page. Throws InputError that names the part that the build lacks.
std::string ReadPage(const std::vector<std::filesystem::path>& places);

}  // namespace tera
