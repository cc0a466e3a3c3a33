#pragma once

#include <filesystem>
#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// Writes diagnosis.json, effects.yaml, report.html and, where there is one, next_manoeuvre.csv
/// into a folder, which is made where it is not there (a WholeFolder's, that all of it appears at
/// once); of each sensor with a map of the ground that too. Throws InputError. `recording` is how
/// the files name it.
void WriteReport(const std::filesystem::path& directory, const Diagnosis& diagnosis,
                 const std::string& recording);

}  // namespace tera
