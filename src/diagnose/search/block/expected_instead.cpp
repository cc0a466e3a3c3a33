#include "diagnose/search/block/expected_instead.h"

#include <deque>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/search/structure/expected_beside.h"

namespace tera {
namespace {

constexpr int kMostInstead = 3;  ///< mechanisms within tolerance that are added

Misfit MisfitWith(const std::vector<Candidate>& expected, const StructureFitter& fitter,
                  FittedStructure best) {
  std::deque<Candidate> held;  // terms refer to them
  for (int added = 0; added < kMostInstead; ++added) {
    const Structure beside = best.terms;
    const double likelihood = best.log_likelihood;
    double most = 0;
    for (const Candidate& one : expected) {
      if (ActsIn(beside, one)) continue;
      held.push_back(HeldBeside(one, beside));
      if (held.back().free.empty()) continue;
      Structure with = beside;
      with.push_back({&held.back(), held.back().starts.front()});
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

}  // namespace

Misfit MisfitOfExpectedInstead(const ReplayBlock& block, const StructureFitter& fitter,
                               const Structure& found, std::size_t term) {
  return MisfitWith(ExpectedBeside(block, found, found[term].candidate->target), fitter,
                    fitter.FitFrom(Without(found, term)));
}

Misfit MisfitOfExpectedBeside(const ReplayBlock& block, const StructureFitter& fitter,
                              const FittedStructure& found) {
  std::set<std::string> targets;
  for (const Candidate& candidate : block.candidates) targets.insert(candidate.target);
  std::vector<Candidate> expected;
  for (const std::string& target : targets) {
    std::vector<Candidate> of_target = ExpectedBeside(block, found.terms, target);
    std::move(of_target.begin(), of_target.end(), std::back_inserter(expected));
  }
  return MisfitWith(expected, fitter, found);
}

}  // namespace tera
