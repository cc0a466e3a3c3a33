#include "diagnose/experiment_design/ambiguity_set.h"

#include <algorithm>

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

const char* const kNothing = "nothing";

bool Has(const Structure& terms, const Candidate* candidate) {
  return std::any_of(terms.begin(), terms.end(),
                     [&](const Term& term) { return term.candidate == candidate; });
}

Structure Without(Structure terms, const Candidate* candidate) {
  std::erase_if(terms, [&](const Term& term) { return term.candidate == candidate; });
  return terms;
}

/// The class of a finding: itself and its rivals, each fitted in its place.
AmbiguitySet ClassOf(const Finding& finding, const Structure& found,
                     const StructureFitter& fitter) {
  AmbiguitySet set;
  set.is_class = true;
  const Structure others = Without(found, finding.term.candidate);
  std::vector<Structure> explanations;
  for (const Candidate* rival : finding.evidence.rivals) {
    set.members.emplace_back(rival->mechanism->id);
    Structure explanation = others;
    explanation.push_back({rival, rival->starts.front()});
    explanations.push_back(rival == finding.term.candidate ? found
                                                           : fitter.FitValues(explanation).terms);
  }
  for (const Structure& truth : explanations) {
    for (const Structure& alternative : explanations) {
      if (&truth != &alternative) set.pairs.push_back({truth, alternative});
    }
    set.pairs.push_back({truth, others});
  }
  return set;
}

}  // namespace

std::vector<AmbiguitySet> AmbiguitySetsOf(const ReplayBlock& block,
                                          const BlockDiagnosis& diagnosis) {
  std::vector<AmbiguitySet> sets;
  const Structure& found = diagnosis.search.found.terms;
  const std::vector<Segment> seen = SeenSegmentsOf(diagnosis.manoeuvres);
  Mask mask(block.samples(), 0);
  for (const Segment& samples : seen) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) mask[k] = 1;
  }
  const Likelihood likelihood(block, diagnosis.noise, mask);
  const StructureFitter fitter(block, likelihood, seen);
  for (const Finding& finding : diagnosis.findings) {
    if (finding.evidence.rivals.size() > 1) sets.push_back(ClassOf(finding, found, fitter));
  }
  for (const Detectability& one : diagnosis.detectability) {
    if (one.smallest || Has(found, one.candidate)) continue;
    const auto& starts = one.candidate->starts;
    Structure truth = found;
    truth.push_back({one.candidate, starts[starts.size() / 2]});
    sets.push_back(
        {{std::string(one.candidate->mechanism->id), kNothing}, false, {{truth, found}}});
  }
  return sets;
}

}  // namespace tera
