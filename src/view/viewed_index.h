#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// The index of a dataset for the page. Throws InputError where it cannot be read.
std::string DatasetIndexJson(const std::filesystem::path& dataset);

/// The index of a diagnosis for the page: its diagnosis.json, and its maps and series by name.
std::string DiagnosisIndexJson(const std::filesystem::path& diagnosis);

}  // namespace tera
