#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Index of a dataset for the page. Throws InputError for an unreadable dataset.
std::string DatasetIndexJson(const std::filesystem::path& dataset);

/// Index of a diagnosis for the page: its diagnosis.json, and its maps and series by name.
std::string DiagnosisIndexJson(const std::filesystem::path& diagnosis);

}  // namespace tera
