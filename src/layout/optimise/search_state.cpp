#include "layout/optimise/search_state.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {

using nlohmann::json;

void SaveState(const SearchState& state, const std::filesystem::path& file) {
  const json out = {
      {"search", state.search_sha256},   {"generation", state.generation}, {"genes", state.genes},
      {"fitness", state.fitness},        {"greedy", state.greedy},         {"corner", state.corner},
      {"hypervolume", state.hypervolume}};
  WriteWholeFile(file, out.dump() + "\n");
}

std::optional<SearchState> LoadState(const std::filesystem::path& file,
                                     const std::string& search_sha256) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  SearchState state;
  try {
    const json from = json::parse(ReadWholeFile(file));
    from.at("search").get_to(state.search_sha256);
    from.at("generation").get_to(state.generation);
    from.at("genes").get_to(state.genes);
    from.at("fitness").get_to(state.fitness);
    from.at("greedy").get_to(state.greedy);
    from.at("corner").get_to(state.corner);
    from.at("hypervolume").get_to(state.hypervolume);
  } catch (const json::exception&) {
    throw InputError(file.string(),
                     {FaultKind::kMalformed, fmt::format("is damaged; delete {} to start afresh",
                                                         file.parent_path().string())});
  }
  if (state.search_sha256 != search_sha256 || state.genes.size() != state.fitness.size()) {
    throw InputError(file.string(),
                     fmt::format("belongs to another search; restore the files of that search and "
                                 "resume it, or delete {} to start afresh",
                                 file.parent_path().string()));
  }
  return state;
}

}  // namespace tera
