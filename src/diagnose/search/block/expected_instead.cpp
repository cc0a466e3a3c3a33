#include "diagnose/search/block/expected_instead.h"

#include <utility>
#include <vector>

#include "diagnose/search/structure/expected_beside.h"

namespace tera {
namespace {

constexpr int kMostInstead = 3;  ///< mechanisms within tolerance that may replace one term

}  // namespace

Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term) {
  const std::vector<Candidate> expected =
      ExpectedBeside(block, found, found[term].candidate->target);
  FittedStructure best = fitter.FitFrom(Without(found, term));
  for (int added = 0; added < kMostInstead; ++added) {
    const Structure beside = best.terms;
    const double likelihood = best.log_likelihood;
    double most = 0;
    for (const Candidate& one : expected) {
      if (ActsIn(beside, one)) continue;
      Structure with = beside;
      with.push_back({&one, one.starts.front()});
      FittedStructure fitted = fitter.FitNear(with);
      const double gain = fitted.log_likelihood - likelihood - static_cast<double>(one.free.size());
      if (gain <= most) continue;
      most = gain;
      best = std::move(fitted);
    }
    if (most == 0) break;
  }
  return std::move(best.misfit);
}

}  // namespace tera
