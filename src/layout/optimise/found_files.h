#pragma once

#include <filesystem>
#include <vector>

#include "layout/optimise/found_layout.h"
#include "layout/optimise/search.h"

namespace tera {

/// Writes what a search found into `folder`: front/NN.yaml and greedy.yaml, rigs that `tera
/// generate` takes as they are; front.csv, the objectives of each; hypervolume.csv, generation by
/// generation; search.html. Throws InputError where a file cannot be written.
void WriteFound(const LayoutSearch& search, const OptimiseResult& result,
                const std::vector<double>& hypervolume, const std::filesystem::path& folder);

/// An objective as its figure has it, not as it was made small.
double ShownValue(double objective);

}  // namespace tera
