#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "layout/optimise/candidate.h"

namespace tera {

/// State of a search after a generation, for resuming.
struct SearchState {
  std::string search_sha256;  ///< of the files that define the search
  int generation = 0;         ///< number of finished generations
  std::vector<Genes> genes;   ///< one per layout of the population
  std::vector<std::vector<double>> fitness;
  Genes greedy;
  std::vector<double> corner;  ///< reference point of the hypervolumes
  /// After each generation; the first entry is the initial population.
  std::vector<double> hypervolume;
};

void SaveState(const SearchState& state, const std::filesystem::path& file);
/// Returns nothing if there is no file. Throws InputError if the file is damaged or belongs to
/// another search.
std::optional<SearchState> LoadState(const std::filesystem::path& file,
                                     const std::string& search_sha256);

}  // namespace tera
