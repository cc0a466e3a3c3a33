#include "diagnose/search/block/evaluation_context.h"

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

Mask Not(Mask mask) {
  for (auto& is : mask) is = !is;
  return mask;
}

}  // namespace

EvaluationContext::EvaluationContext(const ReplayBlock& block, const SearchOptions& options,
                                     const Stream& stream, const std::vector<Manoeuvre>& manoeuvres,
                                     const std::vector<NoiseModel>& noise)
    : block(block),
      options(options),
      stream(stream),
      manoeuvres(manoeuvres),
      select(PiecesOf(SegmentsOf(manoeuvres, Part::kSelect), block.period_s())),
      seen(PiecesOf(SeenSegmentsOf(manoeuvres), block.period_s())),
      final(PiecesOf(SegmentsOf(manoeuvres, Part::kFinal), block.period_s())),
      final_mask(MaskOf(manoeuvres, Part::kFinal, block.samples())),
      seen_mask(Not(final_mask)),
      likelihood(block, noise, seen_mask) {}

}  // namespace tera
