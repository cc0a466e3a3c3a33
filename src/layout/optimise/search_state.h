#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "layout/optimise/candidate.h"

namespace tera {

/// All that a search knows after a generation: with it, it goes on to the same end.
struct SearchState {
  std::string search_sha256;  ///< of the files that it was begun with
  int generation = 0;         ///< how many are done
  std::vector<Genes> genes;   ///< of the population
  std::vector<std::vector<double>> fitness;
  Genes greedy;
  std::vector<double> corner;       ///< that hypervolumes are measured from
  std::vector<double> hypervolume;  ///< after each generation, the first before any
};

void SaveState(const SearchState& state, const std::filesystem::path& file);
/// Nothing where there is none. Throws InputError where it is damaged or of another search.
std::optional<SearchState> LoadState(const std::filesystem::path& file,
                                     const std::string& search_sha256);

}  // namespace tera
