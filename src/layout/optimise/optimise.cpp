#include "layout/optimise/optimise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/random.h"
#include "dataset/files/checked_file.h"
#include "dataset/files/file_digest.h"
#include "dataset/files/folder_lock.h"
#include "dataset/files/whole_folder.h"
#include "layout/optimise/appraisal.h"
#include "layout/optimise/found_files.h"
#include "layout/optimise/greedy.h"
#include "layout/optimise/search_state.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

constexpr char kStateName[] = "search_state.json", kFrontName[] = "front.csv";
constexpr int kGreedyTries = 24;  ///< tested placements of each slot in each round
constexpr int kWorstOf = 10;      ///< for SearchStart::kWorst: random layouts drawn per layout kept
constexpr double kNotAllowed = 1e9;  ///< exceeds every objective of an allowed layout
/// Margin of the reference point beyond the worst initial value, as a share of the spread.
constexpr double kCornerBeyond = 0.1;
constexpr double kLeastSpread = 1e-6;  ///< lower bound on the spread, for equal initial values
// Parameters that NSGA-II's authors use. On average, mutation changes two genes.
constexpr double kCrossover = 0.95, kCrossoverIndex = 10, kMutationIndex = 20;

std::vector<double> FitnessOf(const Appraised& appraised) {
  if (appraised.is_allowed()) return appraised.objectives;
  return std::vector<double>(appraised.objectives.size(), kNotAllowed * (1 + appraised.beyond));
}

/// NSGA-II needs at least two objectives, so a single one is doubled.
std::vector<double> Several(std::vector<double> fitness) {
  if (fitness.size() == 1) fitness.push_back(fitness.front());
  return fitness;
}

bool IsAllowed(const std::vector<double>& fitness) { return fitness.front() < kNotAllowed; }

/// The search in pagmo's interface.
struct Problem {
  const LayoutSearch* search = nullptr;
  const Appraisal* appraisal = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& genes) const {
    return Several(FitnessOf(appraisal->Of(genes)));
  }
  pagmo::vector_double::size_type get_nobj() const {
    return search ? std::max<std::size_t>(2, search->objectives.size()) : 1;
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    if (!search) return {{0}, {1}};
    GeneBounds bounds = BoundsOf(*search);
    return {std::move(bounds.low), std::move(bounds.high)};
  }
  pagmo::vector_double::size_type get_nix() const { return search ? BoundsOf(*search).whole : 0; }
};

/// Uniform within the bounds.
Genes RandomGenes(const LayoutSearch& search, const Stream& stream, std::uint64_t index) {
  const GeneBounds bounds = BoundsOf(search);
  Genes genes = bounds.low;
  for (std::size_t g = 0; g < genes.size(); ++g) {
    const double share = stream.Uniform(index, static_cast<std::uint32_t>(g));
    const bool is_whole = g + bounds.whole >= genes.size();
    const double span = bounds.high[g] - bounds.low[g];
    genes[g] += is_whole ? std::min(span, std::floor(share * (span + 1))) : share * span;
  }
  return genes;
}

std::vector<double> CornerOf(const std::vector<std::vector<double>>& fitness) {
  const std::size_t n = fitness.front().size();
  std::vector<double> low(n, kNotAllowed), high(n, -kNotAllowed), corner(n);
  for (const std::vector<double>& f : fitness) {
    if (!IsAllowed(f)) continue;
    for (std::size_t i = 0; i < n; ++i) {
      low[i] = std::min(low[i], f[i]);
      high[i] = std::max(high[i], f[i]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double spread = std::max(high[i] - low[i], kLeastSpread);
    corner[i] = high[i] + kCornerBeyond * spread;
  }
  return corner;
}

double HypervolumeOf(const SearchState& state) {
  std::vector<pagmo::vector_double> points;
  for (const std::vector<double>& f : state.fitness) {
    const bool is_within = std::equal(f.begin(), f.end(), state.corner.begin(),
                                      [](double value, double most) { return value < most; });
    if (is_within) points.push_back(f);
  }
  if (points.empty()) return 0;
  if (state.corner.size() > 1) return pagmo::hypervolume(points).compute(state.corner);
  const auto best = std::min_element(points.begin(), points.end());
  return state.corner.front() - best->front();
}

void AddRandom(const LayoutSearch& search, const Appraisal& appraisal, int count,
               SearchState* state) {
  const Stream stream(search.seed, "layout/optimise/first");
  const auto first = state->genes.size();
  for (std::size_t i = first; i < first + static_cast<std::size_t>(count); ++i) {
    state->genes.push_back(RandomGenes(search, stream, i));
    state->fitness.push_back(FitnessOf(appraisal.Of(state->genes.back())));
  }
}

/// Keeps the `count` worst allowed layouts: those that the most others dominate.
void KeepWorst(std::size_t count, SearchState* state) {
  std::vector<std::pair<std::size_t, std::size_t>> by_better;
  for (std::size_t i = 0; i < state->genes.size(); ++i) {
    if (!IsAllowed(state->fitness[i])) continue;
    std::size_t better = 0;
    for (const std::vector<double>& other : state->fitness) {
      if (pagmo::pareto_dominance(other, state->fitness[i])) ++better;
    }
    by_better.emplace_back(better, i);
  }
  std::stable_sort(by_better.begin(), by_better.end(), std::greater<>());
  by_better.resize(std::min(by_better.size(), count));
  SearchState kept = *state;
  kept.genes.clear(), kept.fitness.clear();
  for (std::size_t k = 0; !by_better.empty() && k < count; ++k) {
    const std::size_t i = by_better[k % by_better.size()].second;
    kept.genes.push_back(state->genes[i]);
    kept.fitness.push_back(state->fitness[i]);
  }
  *state = std::move(kept);
}

SearchState Begin(const LayoutSearch& search, const Appraisal& appraisal, std::string sha256) {
  SearchState state;
  state.search_sha256 = std::move(sha256);
  state.greedy = Greedy(search, appraisal, kGreedyTries);
  if (search.start == SearchStart::kGreedy) {
    state.genes.push_back(state.greedy);
    state.fitness.push_back(FitnessOf(appraisal.Of(state.greedy)));
  }
  const bool is_worst = search.start == SearchStart::kWorst;
  const int count = search.population - static_cast<int>(state.genes.size());
  AddRandom(search, appraisal, is_worst ? kWorstOf * count : count, &state);
  if (is_worst) KeepWorst(static_cast<std::size_t>(count), &state);
  if (std::none_of(state.fitness.begin(), state.fitness.end(), IsAllowed)) {
    throw InputError("limits",
                     "no layout of the first population keeps them; raise them, make sensors "
                     "optional, or choose a larger population");
  }
  state.corner = CornerOf(state.fitness);
  state.hypervolume.push_back(HypervolumeOf(state));
  return state;
}

void Evolve(const LayoutSearch& search, const Appraisal& appraisal, SearchState* state) {
  const auto seed = static_cast<unsigned>(
      HashText(fmt::format("layout/optimise/{}/{}", search.seed, state->generation)));
  const pagmo::problem problem{Problem{&search, &appraisal}};
  pagmo::population population{problem, 0, seed};
  for (std::size_t i = 0; i < state->genes.size(); ++i) {
    population.push_back(state->genes[i], Several(state->fitness[i]));
  }
  const double mutation = 2.0 / static_cast<double>(state->genes.front().size());
  const pagmo::nsga2 step(1, kCrossover, kCrossoverIndex, std::min(mutation, 1.0), kMutationIndex,
                          seed);
  population = step.evolve(std::move(population));
  state->genes = population.get_x();
  state->fitness = population.get_f();
  for (std::vector<double>& f : state->fitness) f.resize(search.objectives.size());
  ++state->generation;
  state->hypervolume.push_back(HypervolumeOf(*state));
}

/// The non-dominated allowed layouts among the population and `greedy`, if given.
std::vector<FoundLayout> FrontOf(const SearchState& state,
                                 const std::optional<FoundLayout>& greedy) {
  std::vector<FoundLayout> allowed;
  const auto add = [&](const Genes& genes, const std::vector<double>& fitness) {
    const bool is_known = std::any_of(allowed.begin(), allowed.end(), [&](const FoundLayout& f) {
      return f.objectives == fitness;
    });
    if (IsAllowed(fitness) && !is_known) allowed.push_back({genes, fitness});
  };
  if (greedy) add(greedy->genes, greedy->objectives);
  for (std::size_t i = 0; i < state.genes.size(); ++i) add(state.genes[i], state.fitness[i]);
  if (allowed.size() < 2) return allowed;
  std::vector<FoundLayout> front;
  for (const FoundLayout& one : allowed) {
    const bool is_beaten = std::any_of(allowed.begin(), allowed.end(), [&](const FoundLayout& f) {
      return &f != &one && pagmo::pareto_dominance(f.objectives, one.objectives);
    });
    if (!is_beaten) front.push_back(one);
  }
  std::sort(front.begin(), front.end(),
            [](const FoundLayout& a, const FoundLayout& b) { return a.objectives < b.objectives; });
  return front;
}

/// Digest of the files that determine the result.
std::string DigestOf(const LayoutSearch& search, const std::string& search_text,
                     const Cycle& cycle) {
  std::error_code ignored;
  std::vector<fs::path> files = {search.study, search.keep};
  files.push_back(fs::is_directory(search.cycle, ignored) ? search.cycle / "dataset.yaml"
                                                          : search.cycle);
  for (const SensorSlot& slot : search.slots) {
    for (const TypeChoice& type : slot.types) files.push_back(type.preset);
  }
  std::string digests = Sha256Of(search_text) + Sha256Of(cycle.resolved_yaml());
  for (const InputFile& input : cycle.scenario().inputs)
    digests += tera::DigestOf(input.path).sha256;
  for (const fs::path& file : files) {
    digests += file.empty() ? "-" : Sha256Of(ReadWholeFile(file));
  }
  return Sha256Of(digests);
}

void RequireRoom(const fs::path& out, bool resume) {
  std::error_code ignored;
  if (resume && fs::exists(out / kFrontName, ignored)) {
    throw InputError(out.string(), {FaultKind::kUnwritable,
                                    fmt::format("holds a finished search, which cannot be resumed; "
                                                "look at {}, or choose another folder",
                                                (out / "search.html").string())});
  }
  RequireNothingAt(out);
  const fs::path beside = IncompleteOf(out);
  if (resume || !HoldsSomething(beside)) return;
  throw InputError(
      beside.string(),
      {FaultKind::kUnwritable,
       "holds an interrupted search; resume it by the same command with --resume, or delete it"});
}

}  // namespace

OptimiseResult Optimise(const LayoutSearch& search, const std::string& search_text,
                        const OptimiseOptions& options) {
  RequireRoom(options.out, options.resume);
  const LayoutStudy study = LoadStudy(search.study);
  const Cycle cycle(search.cycle, {});
  const Appraisal appraisal(search, study, cycle, options.threads);
  const fs::path folder = IncompleteOf(options.out);
  const std::string sha256 = DigestOf(search, search_text, cycle);
  std::optional<SearchState> resumed = LoadState(folder / kStateName, sha256);
  SearchState state = resumed ? std::move(*resumed) : Begin(search, appraisal, sha256);
  MakeFolder(folder);
  OptimiseResult result;
  result.warnings = appraisal.Warnings();
  {
    const FolderLock lock(folder);
    SaveState(state, folder / kStateName);
    while (state.generation < search.generations) {
      Evolve(search, appraisal, &state);
      SaveState(state, folder / kStateName);
      if (options.progress) {
        options.progress({state.generation, search.generations, state.hypervolume.back()});
      }
    }
    const FoundLayout greedy = {state.greedy, FitnessOf(appraisal.Of(state.greedy))};
    if (IsAllowed(greedy.objectives)) result.greedy = greedy;
    const bool began_with_it = search.start == SearchStart::kGreedy;
    result.front = FrontOf(state, began_with_it ? std::optional(greedy) : std::nullopt);
    WriteFound(search, appraisal.signs(), result, state.hypervolume, folder);
  }
  GiveName(folder, options.out);
  std::error_code ignored;
  fs::remove(options.out / kStateName, ignored);
  return result;
}

}  // namespace tera
