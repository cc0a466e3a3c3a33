#include "layout/optimise/greedy.h"

#include <cmath>
#include <optional>

#include "core/random.h"

namespace tera {
namespace {

/// Redraws one slot with a random type and place.
Genes WithSlot(const LayoutSearch& search, const Genes& genes, std::size_t slot,
               const Stream& stream, std::uint64_t index) {
  Genes with = genes;
  for (std::size_t g = FirstGene(slot); g < FirstGene(slot + 1); ++g) {
    with[g] = stream.Uniform(index, static_cast<std::uint32_t>(g - FirstGene(slot)));
  }
  const std::size_t whole = TypeGene(search, slot);
  const auto pick = [&](std::size_t count, std::uint32_t lane) {
    return std::floor(stream.Uniform(index, lane) * static_cast<double>(count));
  };
  with[whole] = 1 + pick(search.slots[slot].types.size(), 6);
  with[whole + 1] = pick(search.slots[slot].mounts.size(), 7);
  return with;
}

}  // namespace

Genes Greedy(const LayoutSearch& search, const Appraisal& appraisal, int tries) {
  const Stream stream(search.seed, "layout/optimise/greedy");
  Genes genes = BoundsOf(search).low;
  std::vector<bool> taken(search.slots.size(), false);
  std::optional<double> best;
  std::uint64_t index = 0;
  for (std::size_t round = 0; round < search.slots.size(); ++round) {
    std::optional<std::pair<std::size_t, Genes>> chosen;
    for (std::size_t s = 0; s < search.slots.size(); ++s) {
      if (taken[s]) continue;
      for (int t = 0; t < tries; ++t) {
        const Genes with = WithSlot(search, genes, s, stream, index++);
        const Appraised appraised = appraisal.Of(with);
        if (!appraised.is_allowed() || (best && appraised.objectives[0] >= *best)) continue;
        best = appraised.objectives[0];
        chosen = {s, with};
      }
    }
    if (!chosen) break;
    taken[chosen->first] = true;
    genes = chosen->second;
  }
  return genes;
}

}  // namespace tera
