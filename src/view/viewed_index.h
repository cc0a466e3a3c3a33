#pragma once

#include <filesystem>
#include <string>

namespace tera {

/// Index entry of a dataset. Throws InputError if the dataset is unreadable.
std::string DatasetIndexJson(const std::filesystem::path& dataset);

/// Index entry of a diagnosis: its diagnosis.json, and its maps and series by name.
std::string DiagnosisIndexJson(const std::filesystem::path& diagnosis);

}  // namespace tera
