#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "layout/optimise/found_layout.h"
#include "layout/optimise/search.h"

namespace tera {

/// Values of the figures that `objectives` stand for. A maximised figure is a negated objective;
/// its sign is restored. `signs` as in Appraisal.
std::vector<double> ShownValues(const std::vector<double>& objectives,
                                const std::vector<double>& signs);

/// "1 layout", "3 layouts".
std::string LayoutCount(std::size_t count);

/// Writes the result of a search into `folder`: front/NN.yaml and greedy.yaml, rigs for `tera
/// generate`; front.csv, the objectives of each layout; hypervolume.csv, one row per generation;
/// search.html.
///
/// Throws  InputError if a file cannot be written.
void WriteFound(const LayoutSearch& search, const std::vector<double>& signs,
                const OptimiseResult& result, const std::vector<double>& hypervolume,
                const std::filesystem::path& folder);

}  // namespace tera
