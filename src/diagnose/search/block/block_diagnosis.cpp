#include "diagnose/search/block/block_diagnosis.h"

#include <algorithm>
#include <cmath>

#include "core/in_parallel.h"
#include "diagnose/search/block/expected_instead.h"
#include "diagnose/search/block/lost_commands.h"
#include "diagnose/search/block/search_with_noise.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/static_map.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/expected_beside.h"

namespace tera {
namespace {

/// Up to the first p of choice, a term is surely chosen. FINAL then confirms it up to the second p.
/// By Fisher's sum of logarithms, both together are rarer than a choice at 1 % and a confirmation
/// at 5 %.
constexpr double kSurelyChosenP = 1e-5, kConfirmedPOfSurelyChosen = 0.2;
/// Largest ratio of FINAL's RMSE with a finding to that without it. One unusual manoeuvre of eight
/// can cause such a difference.
constexpr double kMostRmseRatio = 1.125;
/// Share of FINAL's excess variance whose removal leaves little more than noise.
constexpr double kNearlyAllExcess = 0.9;
/// Largest number of rivals, the finding included, with which a finding names a cause where error
/// remains.
constexpr std::size_t kLargestNamingClass = 3;
/// A finding with more rivals must remove this share of the excess.
constexpr double kExcessOfLargeClass = 0.75;
/// Smallest share of the excess that the cause of a channel's error removes.
constexpr double kLeastExcessOfCause = 1.0 / 3;
/// Ratio of the RMS that the flexible regressor leaves in place of a finding to the RMS with the
/// finding. Below it, the finding is a proxy.
constexpr double kMostFlexibleRmsRatio = 0.5;

class BlockDiagnoser {
 public:
  BlockDiagnoser(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                 const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise)
      : context_(block, options, stream, manoeuvres, noise),
        fitter_(block, context_.likelihood, SeenSegmentsOf(manoeuvres), options.threads),
        tolerated_(ToleratedErrors()) {}

  /// The result for a block with too few manoeuvres for a search.
  BlockDiagnosis Untested() const;
  BlockDiagnosis Explain(SearchResult search) const;

 private:
  Finding Describe(const SearchResult& search, std::size_t term) const;
  void DescribeAll(BlockDiagnosis* out) const;
  void MoveOut(const std::vector<bool>& is_out, std::vector<Finding>* moved,
               BlockDiagnosis* out) const;
  void Confirm(BlockDiagnosis* out) const;
  void FindUnexplained(BlockDiagnosis* out) const;
  void FindLostCommands(BlockDiagnosis* out) const;
  void CompareWithExpected(BlockDiagnosis* out) const;
  void CompareWithPlainMap(BlockDiagnosis* out) const;
  bool IsProxy(const BlockDiagnosis& out, std::size_t term) const;
  void MoveProxies(BlockDiagnosis* out) const;
  HeldOutError Compare(const FittedStructure& before, const FittedStructure& after,
                       std::size_t channel) const;
  std::size_t MostImproved(const FittedStructure& before, const FittedStructure& after) const;
  ErrorAsExpected AsExpected(const Misfit& found, const Misfit& instead, std::size_t channel) const;
  Tolerated ToleratedErrors() const;

  const EvaluationContext context_;
  const StructureFitter fitter_;  ///< fitted to TRAIN and SELECT
  const Tolerated tolerated_;
};

bool IsNearer(const HeldOutError& error) { return error.rmse_after < error.rmse_before; }

/// True if a finding worsens FINAL by more than one unusual manoeuvre could.
bool IsMuchFurther(const HeldOutError& error) {
  return error.rmse_after > kMostRmseRatio * error.rmse_before;
}

double SteadyLevelOf(const Finding& finding) {
  const HeldOutError& error = finding.held_out;
  const bool is_surely_chosen =
      finding.evidence.steady_p <= kSurelyChosenP ||
      (finding.evidence.p <= kSurelyChosenP && error.excess_removed >= kNearlyAllExcess);
  return is_surely_chosen && IsNearer(error) ? kConfirmedPOfSurelyChosen : kConfirmedP;
}

HeldOutError BlockDiagnoser::Compare(const FittedStructure& before, const FittedStructure& after,
                                     std::size_t channel) const {
  HeldOutError error{channel, 0, 0, 0, 1};
  const double mse_before = MeanSquare(before.misfit.residual[channel], context_.final_mask);
  const double mse_after = MeanSquare(after.misfit.residual[channel], context_.final_mask);
  const double noise = VarianceOf(context_.likelihood.noise()[channel]);
  error.rmse_before = std::sqrt(mse_before);
  error.rmse_after = std::sqrt(mse_after);
  if (mse_before > noise) {
    error.excess_removed = std::clamp((mse_before - mse_after) / (mse_before - noise), -1.0, 1.0);
  }
  error.p = SteadyGainP(
      GainsOf(context_.likelihood, before.misfit, after.misfit, context_.final, channel));
  return error;
}

/// The channel whose mean square on TRAIN and SELECT falls most relative to its noise variance.
/// FINAL must not choose the channel that it judges.
std::size_t BlockDiagnoser::MostImproved(const FittedStructure& before,
                                         const FittedStructure& after) const {
  std::size_t best = 0;
  double most = -INFINITY;
  for (std::size_t c = 0; c < context_.block.channels.size(); ++c) {
    const double gain = (MeanSquare(before.misfit.residual[c], context_.seen_mask) -
                         MeanSquare(after.misfit.residual[c], context_.seen_mask)) /
                        VarianceOf(context_.likelihood.noise()[c]);
    if (gain <= most) continue;
    most = gain;
    best = c;
  }
  return best;
}

Finding BlockDiagnoser::Describe(const SearchResult& search, std::size_t term) const {
  const FittedStructure& found = search.found;
  const FittedStructure without = fitter_.FitValues(Without(found.terms, term));
  Finding finding;
  finding.term = found.terms[term];
  finding.parameters = EstimatesOf(found, term, context_.block.slides);
  finding.evidence = search.evidence[term];
  const std::size_t channel = MostImproved(without, found);
  const NoiseLevel noise =
      NoiseLevelOf(context_.block, channel, found.misfit.residual[channel], context_.seen_mask);
  finding.location = Locate(context_.block.channels[channel], channel,
                            without.misfit.residual[channel], context_.likelihood.noise()[channel],
                            noise, context_.stream, context_.options.threads);
  finding.held_out = Compare(without, found, channel);
  const auto gains = GainsOf(context_.likelihood, without.misfit, found.misfit, context_.final);
  const bool bets = IsNearer(finding.held_out) && finding.evidence.share >= kLeastTermShareOfBet;
  finding.held_out.p = bets ? GainP(gains) : SteadyGainP(gains);
  const bool may_stand =
      IsNearer(finding.held_out) ||
      (finding.evidence.steady_p <= context_.options.alpha && !IsMuchFurther(finding.held_out));
  const double level = SteadyLevelOf(finding);
  finding.is_confirmed =
      may_stand && (bets ? AreConfirming(gains, level) : SteadyGainP(gains) <= level);
  return finding;
}

void BlockDiagnoser::DescribeAll(BlockDiagnosis* out) const {
  out->findings = InParallel<Finding>(out->search.found.terms.size(), context_.options.threads,
                                      [&](std::size_t t) { return Describe(out->search, t); });
}

void BlockDiagnoser::MoveOut(const std::vector<bool>& is_out, std::vector<Finding>* moved,
                             BlockDiagnosis* out) const {
  Structure kept;
  std::vector<TermEvidence> evidence;
  for (std::size_t t = 0; t < is_out.size(); ++t) {
    Finding& finding = out->findings[t];
    if (is_out[t]) {
      moved->push_back(std::move(finding));
    } else {
      kept.push_back(std::move(finding.term));
      evidence.push_back(std::move(finding.evidence));
    }
  }
  out->search.found = fitter_.Determine(fitter_.FitFrom(kept));
  out->search.evidence = std::move(evidence);
  out->search.found_gain.reset();  // the gain of all terms together
  DescribeAll(out);
}

/// Moves out findings that FINAL does not confirm, until all remaining ones are confirmed.
void BlockDiagnoser::Confirm(BlockDiagnosis* out) const {
  while (true) {
    std::vector<bool> is_out;
    for (const Finding& finding : out->findings) is_out.push_back(!finding.is_confirmed);
    if (std::find(is_out.begin(), is_out.end(), true) == is_out.end()) return;
    MoveOut(is_out, &out->unconfirmed, out);
  }
}

void BlockDiagnoser::FindUnexplained(BlockDiagnosis* out) const {
  out->residual_verdicts = ResidualVerdictsOf(context_, out->search);
  out->unexplained =
      UnexplainedOf(context_, fitter_, out->search, out->residual_verdicts, tolerated_);
}

const Unexplained* UnexplainedIn(const BlockDiagnosis& out, std::size_t channel) {
  const auto left =
      std::find_if(out.unexplained.begin(), out.unexplained.end(),
                   [&](const Unexplained& one) { return one.location.channel == channel; });
  return left != out.unexplained.end() ? &*left : nullptr;
}

/// Adds the loss of commands to the findings where it explains error that nothing else explains.
void BlockDiagnoser::FindLostCommands(BlockDiagnosis* out) const {
  if (context_.block.of_chance.empty()) return;
  const Unexplained* left = UnexplainedIn(*out, 0);
  if (left != nullptr && left->p) return;  // an error that depends on a variable is not random
  const auto lost = LostCommandsOf(context_, out->search, out->residual_verdicts[0].noise.rms(),
                                   tolerated_.rms[0]);
  if (!lost) return;
  const Candidate& candidate = context_.block.of_chance.front();
  Finding finding;
  finding.term = {&candidate, {lost->period_s, lost->probability}};
  for (std::size_t i = 0; i < finding.term.values.size(); ++i) {
    const EffectParameter& parameter = candidate.mechanism->parameters[i];
    finding.parameters.push_back({std::string(parameter.name), std::string(parameter.unit),
                                  finding.term.values[i], std::nullopt});
  }
  for (const Hold& hold : lost->holds) finding.location.intervals.push_back(hold.samples);
  finding.evidence.p = finding.evidence.steady_p = finding.held_out.p = lost->p;
  finding.evidence.share = 1;
  finding.evidence.rivals = {&candidate};
  const double noise = VarianceOf(context_.likelihood.noise()[0]);
  finding.held_out.rmse_before = lost->rmse_before;
  finding.held_out.rmse_after = lost->rmse_after;
  const double excess = std::pow(lost->rmse_before, 2) - noise;
  const double taken = std::pow(lost->rmse_before, 2) - std::pow(lost->rmse_after, 2);
  finding.held_out.excess_removed = excess > 0 ? std::clamp(taken / excess, -1.0, 1.0) : 0;
  finding.is_confirmed = true;
  out->findings.push_back(std::move(finding));
  std::erase_if(out->unexplained, [](const Unexplained& one) { return one.location.channel == 0; });
}

bool IsStated(const Candidate& candidate) {
  return std::any_of(candidate.free.begin(), candidate.free.end(),
                     [](const FreeParameter& free) { return free.expected.has_value(); });
}

ErrorAsExpected BlockDiagnoser::AsExpected(const Misfit& found, const Misfit& instead,
                                           std::size_t channel) const {
  const Series &with = found.residual[channel], &without = instead.residual[channel];
  double variance = 0, count = 0;
  for (const Segment& piece : context_.final) {
    double product = 0;
    for (std::size_t k = piece.begin; k < piece.end; ++k) {
      if (!with.valid[k] || !without.valid[k]) continue;
      product += with.value[k] * (without.value[k] - with.value[k]);
      ++count;
    }
    variance += 4 * product * product;
  }
  return {std::sqrt(MeanSquare(without, context_.final_mask)),
          std::sqrt(variance) / std::max(count, 1.0)};
}

/// Sets `tolerated` of all findings, and `as_expected` where it applies (Finding).
void BlockDiagnoser::CompareWithExpected(BlockDiagnosis* out) const {
  const Structure& found = out->search.found.terms;
  for (std::size_t t = 0; t < out->findings.size(); ++t) {
    Finding& finding = out->findings[t];
    const std::size_t channel = finding.held_out.channel;
    finding.tolerated = tolerated_.rms[channel];
    if (t >= found.size()) continue;  // lost commands come last
    if (IsStated(*finding.term.candidate) && finding.evidence.expected_rivals.empty()) continue;
    const Misfit instead = MisfitOfExpectedInstead(context_.block, fitter_, found, t);
    finding.as_expected = AsExpected(out->search.found.misfit, instead, channel);
  }
}

/// Compares the findings with the plain map. If the map is better, all findings become unconfirmed.
void BlockDiagnoser::CompareWithPlainMap(BlockDiagnosis* out) const {
  const ReplayBlock& block = context_.block;
  if (block.channels.size() != 1 || !block.read_whole) return;
  const PlainMap map =
      FitPlainMap(block.commands.front(), block.channels[0].measured, context_.seen_mask);
  const Misfit plain = context_.likelihood.Evaluate({map.predicted});
  const Misfit& found = out->search.found.misfit;
  PlainComparison compared{map.dead_time_s,
                           std::sqrt(MeanSquare(plain.residual[0], context_.final_mask)), false};
  const double rmse = std::sqrt(MeanSquare(found.residual[0], context_.final_mask));
  compared.is_better =
      rmse > kMostRmseRatio * compared.rmse &&
      SteadyGainP(GainsOf(context_.likelihood, found, plain, context_.final)) <= kConfirmedP;
  out->plain = compared;
  if (!compared.is_better || out->findings.empty()) return;
  MoveOut(std::vector<bool>(out->findings.size(), true), &out->unconfirmed, out);
  FindUnexplained(out);
}

/// True if a finding removes too little of FINAL's excess to be its cause.
bool RemovesLittle(const HeldOutError& error) {
  return error.excess_removed != 0 &&
         error.excess_removed < kLeastExcessOfCause;  // 0: FINAL has no excess
}

/// True if the unexplained error of its channel makes a finding a proxy (DiagnoseBlock).
bool BlockDiagnoser::IsProxy(const BlockDiagnosis& out, std::size_t term) const {
  const Finding& finding = out.findings[term];
  const std::size_t channel = finding.held_out.channel;
  const Unexplained* left = UnexplainedIn(out, channel);
  if (left == nullptr) return false;
  if (finding.evidence.rivals.size() > kLargestNamingClass &&
      finding.held_out.excess_removed < kExcessOfLargeClass) {
    return true;
  }
  if (context_.block.channels.size() == 1 && RemovesLittle(finding.held_out)) return true;
  if (finding.evidence.share > left->share) return false;
  const FittedStructure without = fitter_.FitValues(Without(out.search.found.terms, term));
  const Misfit free = ResidualBeyondFlexible(context_.block, context_.likelihood, without.misfit,
                                             context_.manoeuvres);
  const Series& found = out.search.found.misfit.residual[channel];
  return MeanSquare(free.residual[channel], context_.final_mask) <
         kMostFlexibleRmsRatio * kMostFlexibleRmsRatio * MeanSquare(found, context_.final_mask);
}

/// Moves proxies out of the findings one by one, the one with the smallest share first. A finding
/// stays if its channel would otherwise be explained.
void BlockDiagnoser::MoveProxies(BlockDiagnosis* out) const {
  std::vector<const Candidate*> stay;
  while (true) {
    std::optional<std::size_t> least;
    for (std::size_t t = 0; t < out->findings.size(); ++t) {
      const Finding& finding = out->findings[t];
      if (std::find(stay.begin(), stay.end(), finding.term.candidate) != stay.end()) continue;
      const bool is_less = !least || finding.evidence.share < out->findings[*least].evidence.share;
      if (is_less && IsProxy(*out, t)) least = t;
    }
    if (!least) return;
    const std::size_t channel = out->findings[*least].held_out.channel;
    std::vector<bool> is_out(out->findings.size(), false);
    is_out[*least] = true;
    BlockDiagnosis without = *out;
    MoveOut(is_out, &without.proxies, &without);
    Confirm(&without);
    FindUnexplained(&without);
    if (UnexplainedIn(without, channel) == nullptr) {
      stay.push_back(out->findings[*least].term.candidate);
    } else {
      *out = std::move(without);
    }
  }
}

/// True for a rate factor, whose neutral value is 1. The asymmetry of tracks is a factor of each
/// track.
bool IsRateFactor(const Candidate& candidate) {
  const auto& free = candidate.free;
  return !free.empty() && free.front().expected &&
         (free.front().expected->neutral == 1 || candidate.mechanism->id == "track_asymmetry");
}

/// The candidate with its first parameter that has a tolerance, at the end of the tolerance farther
/// from neutral. None without a stated tolerance.
std::optional<Term> AtTolerance(const Candidate& candidate) {
  const Candidate held = HeldToExpected(candidate);
  if (held.free.empty()) return std::nullopt;
  const FreeParameter& main = held.free.front();
  Term term{&candidate, held.starts.front()};
  const double neutral = main.expected->neutral;
  const bool is_upper_farther = main.upper - neutral > neutral - main.lower + 1e-9;
  term.values[main.index] = is_upper_farther ? main.upper : main.lower;
  return term;
}

Tolerated BlockDiagnoser::ToleratedErrors() const {
  Tolerated out{{}, std::vector<double>(context_.block.channels.size(), 0.0)};
  const auto nothing = context_.block.predict({});
  for (const Candidate& candidate : context_.block.candidates) {
    const std::optional<Term> accepted = AtTolerance(candidate);
    if (!accepted) continue;
    const auto predicted = context_.block.predict({*accepted});
    out.changes.push_back(predicted);
    for (std::size_t c = 0; c < predicted.size(); ++c) {
      for (std::size_t k = 0; k < predicted[c].size(); ++k) {
        out.changes.back()[c][k] -= nothing[c][k];
      }
    }
    if (!IsRateFactor(candidate)) continue;
    const Misfit change = context_.likelihood.EvaluateAgainst(predicted, nothing);
    for (std::size_t c = 0; c < out.rms.size(); ++c) {
      const double square = MeanSquare(change.residual[c], context_.final_mask);
      out.rms[c] = std::max(out.rms[c], std::sqrt(square));
    }
  }
  return out;
}

BlockDiagnosis BlockDiagnoser::Untested() const {
  BlockDiagnosis out;
  out.is_testable = false;
  out.manoeuvres = context_.manoeuvres;
  out.noise = context_.likelihood.noise();
  out.search.nothing = out.search.found = fitter_.AsGiven({});
  for (const Candidate& candidate : context_.block.candidates)
    out.detectability.push_back({&candidate, {}});
  return out;
}

BlockDiagnosis BlockDiagnoser::Explain(SearchResult search) const {
  BlockDiagnosis out;
  out.manoeuvres = context_.manoeuvres;
  out.noise = context_.likelihood.noise();
  out.search = std::move(search);
  DescribeAll(&out);
  Confirm(&out);
  FindUnexplained(&out);
  MoveProxies(&out);
  CompareWithPlainMap(&out);
  FindLostCommands(&out);
  CompareWithExpected(&out);
  out.detectability = InParallel<Detectability>(
      context_.block.candidates.size(), context_.options.threads,
      [&](std::size_t s) { return DetectabilityOf(context_, context_.block.candidates[s]); });
  for (std::size_t c = 0; c < context_.block.channels.size(); ++c) {
    out.confirmed.push_back(Compare(out.search.nothing, out.search.found, c));
  }
  return out;
}

}  // namespace

std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream) {
  return SplitByManoeuvre(block.commands, stream);
}

BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream) {
  const std::vector<Manoeuvre> manoeuvres = ManoeuvresOf(block, stream);
  if (!IsTestable(manoeuvres)) {
    return BlockDiagnoser(block, options, stream, manoeuvres, NoiseOfBlock(block, manoeuvres))
        .Untested();
  }
  SearchedBlock searched = SearchBlock(block, options, stream, manoeuvres);
  return BlockDiagnoser(block, options, stream, manoeuvres, searched.noise)
      .Explain(std::move(searched.search));
}

}  // namespace tera
