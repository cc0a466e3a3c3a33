#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "layout/optimise/found_layout.h"
#include "layout/optimise/search.h"

namespace tera {

/// Objectives as their figures have them, not as they were made small; `signs` as Appraisal has
/// them.
std::vector<double> ShownValues(const std::vector<double>& objectives,
                                const std::vector<double>& signs);

/// "1 layout", "3 layouts".
std::string LayoutCount(std::size_t count);

/// Writes what a search found into `folder`: front/NN.yaml and greedy.yaml, rigs that `tera
/// generate` takes as they are; front.csv, the objectives of each; hypervolume.csv, generation by
/// generation; search.html. Throws InputError where a file cannot be written.
void WriteFound(const LayoutSearch& search, const std::vector<double>& signs,
                const OptimiseResult& result, const std::vector<double>& hypervolume,
                const std::filesystem::path& folder);

}  // namespace tera
