#include "diagnose/search/block/block_diagnosis.h"

#include <algorithm>
#include <cmath>

#include "core/in_parallel.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/prefix.h"

namespace tera {
namespace {

constexpr std::size_t kFewestSeen = 6;   ///< manoeuvres of TRAIN and SELECT that move
constexpr std::size_t kFewestFinal = 3;  ///< of FINAL; steady_gain.h needs them
/// Of a term that was chosen so surely; together they are rarer than a choice at one per cent and a
/// confirmation at five (Fisher's sum of logarithms).
constexpr double kSurelyChosenP = 1e-5, kSurelyChosenSteadyP = 0.2;
constexpr double kMuchFurther = 1.125;    ///< of FINAL's RMSE: one manoeuvre of eight may differ so
constexpr double kAll = 0.9;              ///< of the excess: next to nothing but noise is left
constexpr std::size_t kLargestClass = 3;  ///< that names something, where error remains
constexpr double kMost = 0.75;            ///< of the excess: enough to name several for
constexpr double kLittle = 1.0 / 3;       ///< of the excess: too little to be what is wrong
constexpr double kMuchLess = 0.5;         ///< RMS, that the flexible regressor leaves
constexpr int kPasses = 3;                ///< of noise and search
/// Of the variance of a channel's noise, and of the scale of its innovations: less by so much is
/// worth another search.
constexpr double kQuieter = 0.5, kQuieterInnovations = 0.7;

/// Enough of them in which something was commanded.
bool IsTestable(const std::vector<Manoeuvre>& manoeuvres) {
  std::size_t seen = 0, final = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.axes != 0) ++(manoeuvre.part == Part::kFinal ? final : seen);
  }
  return seen >= kFewestSeen && final >= kFewestFinal;
}

class Procedure {
 public:
  Procedure(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
            const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise)
      : judged_(block, options, stream, manoeuvres, noise),
        fitter_(block, judged_.likelihood, SeenSegmentsOf(manoeuvres), options.threads) {}

  /// As it stands, without a search.
  BlockDiagnosis Untested() const;
  StructureSearch SearchAfter(const EarlierSearch& earlier) const;
  BlockDiagnosis Explain(SearchResult search) const;

 private:
  Finding Describe(const SearchResult& search, std::size_t term) const;
  void DescribeAll(BlockDiagnosis* out) const;
  void TakeOut(const std::vector<bool>& is_out, std::vector<Finding>* taken,
               BlockDiagnosis* out) const;
  void Confirm(BlockDiagnosis* out) const;
  void FindUnexplained(BlockDiagnosis* out) const;
  bool IsProxy(const BlockDiagnosis& out, std::size_t term) const;
  void MoveProxies(BlockDiagnosis* out) const;
  HeldOutError Compare(const FittedStructure& before, const FittedStructure& after,
                       std::size_t channel) const;
  std::size_t MostImproved(const FittedStructure& before, const FittedStructure& after) const;

  const JudgedBlock judged_;
  const StructureFitter fitter_;  ///< to TRAIN and SELECT
};

bool IsNearer(const HeldOutError& error) { return error.rmse_after < error.rmse_before; }

/// A few manoeuvres may be of another kind, but what makes all of FINAL worse is no explanation.
bool IsMuchFurther(const HeldOutError& error) {
  return error.rmse_after > kMuchFurther * error.rmse_before;
}

/// At which a steady gain on FINAL confirms a finding.
double SteadyLevelOf(const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  const bool is_sure = finding.evidence.steady_p <= kSurelyChosenP ||
                       (finding.evidence.p <= kSurelyChosenP && error.excess_removed >= kAll);
  return is_sure && IsNearer(error) ? kSurelyChosenSteadyP : kConfirmedP;
}

HeldOutError Procedure::Compare(const FittedStructure& before, const FittedStructure& after,
                                std::size_t channel) const {
  HeldOutError error{channel, 0, 0, 0, 1};
  const double mse_before = MeanSquare(before.misfit.residual[channel], judged_.final_mask);
  const double mse_after = MeanSquare(after.misfit.residual[channel], judged_.final_mask);
  const double noise = VarianceOf(judged_.likelihood.noise()[channel]);
  error.rmse_before = std::sqrt(mse_before);
  error.rmse_after = std::sqrt(mse_after);
  if (mse_before > noise) {
    error.excess_removed = std::clamp((mse_before - mse_after) / (mse_before - noise), -1.0, 1.0);
  }
  error.p =
      SteadyGainP(GainsOf(judged_.likelihood, before.misfit, after.misfit, judged_.final, channel));
  return error;
}

/// By how much of its noise's variance, and not by FINAL, which is not to choose what it is asked
/// about.
std::size_t Procedure::MostImproved(const FittedStructure& before,
                                    const FittedStructure& after) const {
  std::size_t best = 0;
  double most = -INFINITY;
  for (std::size_t c = 0; c < judged_.block.channels.size(); ++c) {
    const double gain = (MeanSquare(before.misfit.residual[c], judged_.seen_mask) -
                         MeanSquare(after.misfit.residual[c], judged_.seen_mask)) /
                        VarianceOf(judged_.likelihood.noise()[c]);
    if (gain <= most) continue;
    most = gain;
    best = c;
  }
  return best;
}

Finding Procedure::Describe(const SearchResult& search, std::size_t term) const {
  const FittedStructure& found = search.found;
  const FittedStructure without = fitter_.FitValues(Without(found.terms, term));
  Finding finding;
  finding.term = found.terms[term];
  finding.parameters = EstimatesOf(found, term, judged_.block.slides);
  finding.evidence = search.evidence[term];
  const std::size_t channel = MostImproved(without, found);
  const NoiseLevel noise =
      NoiseLevelOf(judged_.block, channel, found.misfit.residual[channel], judged_.seen_mask);
  finding.location =
      Locate(judged_.block.channels[channel], channel, without.misfit.residual[channel],
             judged_.likelihood.noise()[channel], noise, judged_.stream, judged_.options.threads);
  finding.held_out = Compare(without, found, channel);
  const auto gains = GainsOf(judged_.likelihood, without.misfit, found.misfit, judged_.final);
  const bool bets =
      IsNearer(finding.held_out) && finding.evidence.share >= judged_.options.least_share_of_bet;
  finding.held_out.p = bets ? GainP(gains) : SteadyGainP(gains);
  const bool may_stand =
      IsNearer(finding.held_out) ||
      (finding.evidence.steady_p <= judged_.options.alpha && !IsMuchFurther(finding.held_out));
  const double level = SteadyLevelOf(finding);
  finding.is_confirmed =
      may_stand && (bets ? AreConfirming(gains, level) : SteadyGainP(gains) <= level);
  return finding;
}

void Procedure::DescribeAll(BlockDiagnosis* out) const {
  out->findings = InParallel<Finding>(out->search.found.terms.size(), judged_.options.threads,
                                      [&](std::size_t t) { return Describe(out->search, t); });
}

/// Parts some findings from the others, which are fitted anew on their own.
void Procedure::TakeOut(const std::vector<bool>& is_out, std::vector<Finding>* taken,
                        BlockDiagnosis* out) const {
  Structure kept;
  std::vector<TermEvidence> evidence;
  for (std::size_t t = 0; t < is_out.size(); ++t) {
    Finding& finding = out->findings[t];
    if (is_out[t]) {
      taken->push_back(std::move(finding));
    } else {
      kept.push_back(std::move(finding.term));
      evidence.push_back(std::move(finding.evidence));
    }
  }
  out->search.found = fitter_.Determine(fitter_.FitFrom(kept));
  out->search.evidence = std::move(evidence);
  out->search.found_gain.reset();  // it was of them all
  DescribeAll(out);
}

/// Parts what FINAL confirms from what it does not, until it confirms all that is left.
void Procedure::Confirm(BlockDiagnosis* out) const {
  while (true) {
    std::vector<bool> is_out;
    for (const Finding& finding : out->findings) is_out.push_back(!finding.is_confirmed);
    if (std::find(is_out.begin(), is_out.end(), true) == is_out.end()) return;
    TakeOut(is_out, &out->unconfirmed, out);
  }
}

void Procedure::FindUnexplained(BlockDiagnosis* out) const {
  out->residual_verdicts = ResidualVerdictsOf(judged_, out->search);
  out->unexplained = UnexplainedOf(judged_, out->search, out->residual_verdicts);
}

const Unexplained* UnexplainedIn(const BlockDiagnosis& out, std::size_t channel) {
  const auto left =
      std::find_if(out.unexplained.begin(), out.unexplained.end(),
                   [&](const Unexplained& one) { return one.location.channel == channel; });
  return left != out.unexplained.end() ? &*left : nullptr;
}

/// Whether of an excess that FINAL shows a finding takes little.
bool TakesLittle(const HeldOutError& error) {
  return error.excess_removed != 0 && error.excess_removed < kLittle;  // 0: none shows
}

/// Whether what its channel leaves unexplained shows that a finding is a proxy for something else.
bool Procedure::IsProxy(const BlockDiagnosis& out, std::size_t term) const {
  const Finding& finding = out.findings[term];
  const std::size_t channel = finding.held_out.channel;
  const Unexplained* left = UnexplainedIn(out, channel);
  if (left == nullptr) return false;
  if (finding.evidence.rivals.size() > kLargestClass && finding.held_out.excess_removed < kMost) {
    return true;
  }
  if (judged_.block.channels.size() == 1 && TakesLittle(finding.held_out)) return true;
  if (finding.evidence.share > left->share) return false;
  const FittedStructure without = fitter_.FitValues(Without(out.search.found.terms, term));
  const Misfit free =
      ResidualBeyondFlexible(judged_.block, judged_.likelihood, without.misfit, judged_.manoeuvres);
  const Series& found = out.search.found.misfit.residual[channel];
  return MeanSquare(free.residual[channel], judged_.final_mask) <
         kMuchLess * kMuchLess * MeanSquare(found, judged_.final_mask);
}

/// Moves proxies out of the findings, one after the other, the one that explains least first. A
/// finding without which nothing is unexplained any more is no proxy, and stays.
void Procedure::MoveProxies(BlockDiagnosis* out) const {
  std::vector<const Suspect*> stay;
  while (true) {
    std::optional<std::size_t> least;
    for (std::size_t t = 0; t < out->findings.size(); ++t) {
      const Finding& finding = out->findings[t];
      if (std::find(stay.begin(), stay.end(), finding.term.suspect) != stay.end()) continue;
      const bool is_less = !least || finding.evidence.share < out->findings[*least].evidence.share;
      if (is_less && IsProxy(*out, t)) least = t;
    }
    if (!least) return;
    const std::size_t channel = out->findings[*least].held_out.channel;
    std::vector<bool> is_out(out->findings.size(), false);
    is_out[*least] = true;
    BlockDiagnosis without = *out;
    TakeOut(is_out, &without.proxies, &without);
    Confirm(&without);
    FindUnexplained(&without);
    if (UnexplainedIn(without, channel) == nullptr) {
      stay.push_back(out->findings[*least].term.suspect);
    } else {
      *out = std::move(without);
    }
  }
}

BlockDiagnosis Procedure::Untested() const {
  BlockDiagnosis out;
  out.is_testable = false;
  out.manoeuvres = judged_.manoeuvres;
  out.noise = judged_.likelihood.noise();
  out.search.nothing = out.search.found = fitter_.AsGiven({});
  for (const Suspect& suspect : judged_.block.suspects) out.detectability.push_back({&suspect, {}});
  return out;
}

StructureSearch Procedure::SearchAfter(const EarlierSearch& earlier) const {
  return {judged_.block, judged_.likelihood.noise(), fitter_, judged_.manoeuvres, judged_.options,
          earlier};
}

BlockDiagnosis Procedure::Explain(SearchResult search) const {
  BlockDiagnosis out;
  out.manoeuvres = judged_.manoeuvres;
  out.noise = judged_.likelihood.noise();
  out.search = std::move(search);
  DescribeAll(&out);
  Confirm(&out);
  FindUnexplained(&out);
  MoveProxies(&out);
  out.detectability = InParallel<Detectability>(
      judged_.block.suspects.size(), judged_.options.threads,
      [&](std::size_t s) { return DetectabilityOf(judged_, judged_.block.suspects[s]); });
  for (std::size_t c = 0; c < judged_.block.channels.size(); ++c) {
    out.confirmed.push_back(Compare(out.search.nothing, out.search.found, c));
  }
  return out;
}

/// Whether any channel's noise is much less than it was taken for.
bool IsMuchQuieter(const std::vector<NoiseModel>& now, const std::vector<NoiseModel>& before) {
  for (std::size_t c = 0; c < now.size(); ++c) {
    if (VarianceOf(now[c]) < kQuieter * VarianceOf(before[c])) return true;
    if (now[c].scale < kQuieterInnovations * before[c].scale) return true;
  }
  return false;
}

/// What was found, under noise that was estimated beside it.
struct Searched {
  std::vector<NoiseModel> noise;
  SearchResult search;
};

/// Noise and search in turn.
Searched SearchInTurn(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                      const std::vector<Manoeuvre>& manoeuvres) {
  EarlierSearch earlier;
  SearchResult before;
  Searched last{NoiseOfBlock(block, manoeuvres), {}};
  for (int pass = 1;; ++pass) {
    const Procedure procedure(block, options, stream, manoeuvres, last.noise);
    StructureSearch search = procedure.SearchAfter(earlier);
    last.search = search.Find();
    std::vector<NoiseModel> less = NoiseOfBlock(block, manoeuvres, last.search.found.terms);
    if (pass == kPasses || last.search.found.terms.empty() || !IsMuchQuieter(less, last.noise)) {
      search.DiscriminateRivals(&last.search);
      return last;
    }
    last.noise = std::move(less);
    before = std::move(last.search);
    earlier = {&before, false};
  }
}

/// From what the block's prefix told, under the noise that there is beside it.
Searched SearchOn(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                  const std::vector<Manoeuvre>& manoeuvres, const SearchResult& prefix_result) {
  std::vector<NoiseModel> noise = NoiseOfBlock(block, manoeuvres, prefix_result.found.terms);
  const Procedure procedure(block, options, stream, manoeuvres, noise);
  StructureSearch search = procedure.SearchAfter({&prefix_result, true});
  SearchResult found = search.Find();
  search.DiscriminateRivals(&found);
  return {std::move(noise), std::move(found)};
}

Searched SearchFor(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                   const std::vector<Manoeuvre>& manoeuvres) {
  const std::size_t enough = PrefixLength(manoeuvres, block.period_s());
  const std::vector<Manoeuvre> first = Within(manoeuvres, enough);
  if (enough == block.samples() || !IsTestable(first)) {
    return SearchInTurn(block, options, stream, manoeuvres);
  }
  const ReplayBlock prefix = PrefixOf(block, enough);
  SearchResult prefix_result = SearchInTurn(prefix, options, stream, first).search;
  return SearchOn(block, options, stream, manoeuvres,
                  CarryToWhole(std::move(prefix_result), prefix, block));
}

}  // namespace

std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream) {
  return SplitByManoeuvre(block.commands, {}, stream);
}

BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream) {
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(block, stream);
  if (!IsTestable(manoeuvres)) {
    return Procedure(block, options, stream, manoeuvres, NoiseOfBlock(block, manoeuvres))
        .Untested();
  }
  Searched searched = SearchFor(block, options, stream, manoeuvres);
  return Procedure(block, options, stream, manoeuvres, searched.noise)
      .Explain(std::move(searched.search));
}

}  // namespace tera
