#include "diagnose/search/block/search_with_noise.h"

#include <utility>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/block/testable.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/prefix_search.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {
namespace {

constexpr int kMostPasses = 3;
/// Ratios of new to old noise variance and innovation scale below which the search is repeated.
constexpr double kMuchQuieterVariance = 0.5, kMuchQuieterInnovations = 0.7;

struct Pass {
  Pass(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
       const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise)
      : context(block, options, stream, manoeuvres, noise),
        fitter(block, context.likelihood, SeenSegmentsOf(manoeuvres), options.threads) {}

  StructureSearch SearchAfter(const EarlierSearch& earlier) const {
    return {context.block, context.likelihood.noise(), fitter, context.manoeuvres, context.options,
            earlier};
  }

  const EvaluationContext context;
  const StructureFitter fitter;  ///< fitted to TRAIN and SELECT
};

/// True if the noise of any channel is much smaller than in the previous estimate.
bool IsMuchQuieter(const std::vector<NoiseModel>& now, const std::vector<NoiseModel>& before) {
  for (std::size_t c = 0; c < now.size(); ++c) {
    if (VarianceOf(now[c]) < kMuchQuieterVariance * VarianceOf(before[c])) return true;
    if (now[c].scale < kMuchQuieterInnovations * before[c].scale) return true;
  }
  return false;
}

SearchedBlock SearchInTurn(const ReplayBlock& block, const SearchOptions& options,
                           const Stream& stream, const std::vector<Manoeuvre>& manoeuvres) {
  EarlierSearch earlier;
  SearchResult before;
  SearchedBlock last{NoiseOfBlock(block, manoeuvres), {}};
  for (int pass = 1;; ++pass) {
    const Pass one(block, options, stream, manoeuvres, last.noise);
    StructureSearch search = one.SearchAfter(earlier);
    last.search = search.Find();
    std::vector<NoiseModel> less = NoiseOfBlock(block, manoeuvres, last.search.fullest);
    if (pass == kMostPasses || last.search.fullest.empty() || !IsMuchQuieter(less, last.noise)) {
      search.DiscriminateRivals(&last.search);
      return last;
    }
    last.noise = std::move(less);
    before = std::move(last.search);
    earlier = {&before, false};
  }
}

/// Searches the whole block, starting from the result of its prefix. The noise is estimated with
/// the fullest structure of the prefix.
SearchedBlock SearchWhole(const ReplayBlock& block, const SearchOptions& options,
                          const Stream& stream, const std::vector<Manoeuvre>& manoeuvres,
                          const SearchResult& prefix_result) {
  std::vector<NoiseModel> noise = NoiseOfBlock(block, manoeuvres, prefix_result.fullest);
  const Pass whole(block, options, stream, manoeuvres, noise);
  StructureSearch search = whole.SearchAfter({&prefix_result, true});
  SearchResult found = search.Find();
  search.DiscriminateRivals(&found);
  return {std::move(noise), std::move(found)};
}

}  // namespace

SearchedBlock SearchBlock(const ReplayBlock& block, const SearchOptions& options,
                          const Stream& stream, const std::vector<Manoeuvre>& manoeuvres) {
  const std::size_t length = PrefixLength(manoeuvres, block.period_s());
  const std::vector<Manoeuvre> first = Within(manoeuvres, length);
  if (length == block.samples() || !IsTestable(first)) {
    return SearchInTurn(block, options, stream, manoeuvres);
  }
  const ReplayBlock prefix = PrefixOf(block, length);
  SearchResult prefix_result = SearchInTurn(prefix, options, stream, first).search;
  return SearchWhole(block, options, stream, manoeuvres,
                     CarryToWhole(std::move(prefix_result), prefix, block));
}

}  // namespace tera
