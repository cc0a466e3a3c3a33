#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tera {

/// Where a page that holds data has them, in place of this.
inline constexpr std::string_view kPackMark = "<!--pack-->";

/// Where the built page may be: beside the installed data, and in the folder of this build.
std::vector<std::filesystem::path> PagePlaces();

/// The first page of these that is there. Throws InputError that says what the build lacked.
std::string ReadPage(const std::vector<std::filesystem::path>& places);

}  // namespace tera
