#include "diagnose/search/block_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/in_parallel.h"
#include "diagnose/search/beginning.h"
#include "diagnose/search/free_member.h"
#include "diagnose/search/steady_gain.h"

namespace tera {
namespace {

constexpr std::size_t kFewestSeen = 6;   ///< manoeuvres of TRAIN and SELECT that move
constexpr std::size_t kFewestFinal = 3;  ///< of FINAL; steady_gain.h needs them
constexpr double kLongest_s = 3;  ///< of a manoeuvre: a machine that is driven on does much in it
constexpr double kSeen =
    20;  ///< gain in log-likelihood that the criterion asks for on TRAIN, and as much of SELECT
constexpr std::uint64_t kDraws = 20;  ///< of noise, of which three quarters are to show a suspect
constexpr double kLeastUnexplained = 0.05;
constexpr double kUnconfirmedP = 0.05;
/// Of a term that was chosen so surely; together they are rarer than a choice at one per cent and a
/// confirmation at five (Fisher's sum of logarithms).
constexpr double kSurelyChosenP = 1e-5, kSurelyUnconfirmedP = 0.2;
constexpr double kLoudWithoutRest = 10;
constexpr double kMuchLouder = 5;  ///< times the noise: error, if in several manoeuvres of all
constexpr std::size_t kSeveral = 3;
constexpr double kLoud = 2;        ///< times the noise: error, not noise
constexpr double kNominal = 0.03;  ///< of a channel's RMS: nominal numbers are known no better
constexpr double kForm = 0.02;     ///< of an excess: its form in the library is no better
constexpr int kPasses = 3;         ///< of noise and search
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

Mask Not(Mask mask) {
  for (auto& is : mask) is = !is;
  return mask;
}

class Procedure {
 public:
  Procedure(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
            const std::vector<Manoeuvre>& manoeuvres, const std::vector<NoiseModel>& noise)
      : block_(block),
        options_(options),
        stream_(stream),
        manoeuvres_(manoeuvres),
        select_(PiecesOf(SegmentsOf(manoeuvres_, Part::kSelect), block.period_s())),
        seen_(PiecesOf(SeenSegmentsOf(manoeuvres_), block.period_s())),
        final_(PiecesOf(SegmentsOf(manoeuvres_, Part::kFinal), block.period_s())),
        final_mask_(MaskOf(manoeuvres_, Part::kFinal, block.samples())),
        likelihood_(block, noise, Not(final_mask_)),
        fitter_(block, likelihood_, SeenSegmentsOf(manoeuvres_), options.threads) {}

  /// As it stands, without a search.
  BlockDiagnosis Untested() const;
  StructureSearch SearchAfter(const EarlierSearch& earlier) const;
  BlockDiagnosis Explain(SearchResult search) const;

 private:
  Finding Describe(const SearchResult& search, std::size_t term) const;
  void Confirm(BlockDiagnosis* out) const;
  void FindRemainders(const SearchResult& search, BlockDiagnosis* out) const;
  double QuietOf(const Remainder& remainder, const SearchResult& search, double loud) const;
  void JudgeRemainder(const SearchResult& search, Remainder* remainder) const;
  std::optional<double> FollowedP(const Misfit& misfit, const Misfit& free,
                                  const std::function<const Misfit&()>& ask_all,
                                  const Remainder& remainder) const;
  void FindUnexplained(BlockDiagnosis* out) const;
  Detectability DetectabilityOf(const Suspect& suspect) const;
  bool WouldBeSeen(const Misfit& difference) const;
  HeldOutError Compare(const FittedStructure& before, const FittedStructure& after,
                       std::size_t channel) const;
  std::size_t MostImproved(const FittedStructure& before, const FittedStructure& after) const;

  const ReplayBlock& block_;
  const SearchOptions& options_;
  const Stream& stream_;
  const std::vector<Manoeuvre>& manoeuvres_;
  const std::vector<Segment> select_, seen_, final_;  ///< in pieces
  const Mask final_mask_;
  const Likelihood likelihood_;   ///< of TRAIN and SELECT
  const StructureFitter fitter_;  ///< to TRAIN and SELECT
};

double MeanSquare(const Series& residual, const Mask& mask) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (!mask[k] || !residual.valid[k]) continue;
    sum += residual.value[k] * residual.value[k];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Mean square over the samples of a segment that are there.
double MeanSquare(const Series& residual, const Segment& samples) {
  Mask mask(residual.size(), 0);
  for (std::size_t k = samples.begin; k < samples.end; ++k) mask[k] = 1;
  return MeanSquare(residual, mask);
}

bool IsNearer(const HeldOutError& error) { return error.rmse_after < error.rmse_before; }

/// At which a steady gain on FINAL confirms a finding.
double LevelOf(const Finding& finding) {
  const bool is_sure = finding.evidence.steady_p <= kSurelyChosenP && IsNearer(finding.held_out);
  return is_sure ? kSurelyUnconfirmedP : kUnconfirmedP;
}

HeldOutError Procedure::Compare(const FittedStructure& before, const FittedStructure& after,
                                std::size_t channel) const {
  HeldOutError error{channel, 0, 0, 0, 1};
  const double mse_before = MeanSquare(before.misfit.residual[channel], final_mask_);
  const double mse_after = MeanSquare(after.misfit.residual[channel], final_mask_);
  const double noise = VarianceOf(likelihood_.noise()[channel]);
  error.rmse_before = std::sqrt(mse_before);
  error.rmse_after = std::sqrt(mse_after);
  if (mse_before > noise) {
    error.excess_removed = std::clamp((mse_before - mse_after) / (mse_before - noise), -1.0, 1.0);
  }
  error.p = SteadyGainP(GainsOf(likelihood_, before.misfit, after.misfit, final_, channel));
  return error;
}

/// By how much of its noise's variance, and not by FINAL, which is not to choose what it is asked
/// about.
std::size_t Procedure::MostImproved(const FittedStructure& before,
                                    const FittedStructure& after) const {
  const Mask seen = Not(final_mask_);
  std::size_t best = 0;
  double most = -INFINITY;
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    const double gain =
        (MeanSquare(before.misfit.residual[c], seen) - MeanSquare(after.misfit.residual[c], seen)) /
        VarianceOf(likelihood_.noise()[c]);
    if (gain <= most) continue;
    most = gain;
    best = c;
  }
  return best;
}

Finding Procedure::Describe(const SearchResult& search, std::size_t term) const {
  const FittedStructure& found = search.found;
  Structure others = found.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(term));
  const FittedStructure without = fitter_.FitValues(others);
  Finding finding;
  finding.term = found.terms[term];
  finding.parameters = EstimatesOf(found, term, block_.slides);
  finding.evidence = search.evidence[term];
  const std::size_t channel = MostImproved(without, found);
  const NoiseLevel level =
      NoiseLevelOf(block_, channel, found.misfit.residual[channel], Not(final_mask_));
  finding.location = Locate(block_.channels[channel], channel, without.misfit.residual[channel],
                            likelihood_.noise()[channel], level, stream_, options_.threads);
  finding.held_out = Compare(without, found, channel);
  const auto gains = GainsOf(likelihood_, without.misfit, found.misfit, final_);
  const bool bets =
      IsNearer(finding.held_out) && finding.evidence.share >= options_.least_share_of_bet;
  finding.held_out.p = bets ? GainP(gains) : SteadyGainP(gains);
  finding.is_confirmed =
      bets ? AreConfirming(gains, LevelOf(finding)) : SteadyGainP(gains) <= LevelOf(finding);
  return finding;
}

/// What a mean square may be and still be noise, nominal numbers, and what the forms of mechanisms
/// that were found differ by from what they stand for.
double Procedure::QuietOf(const Remainder& remainder, const SearchResult& search,
                          double loud) const {
  const std::size_t c = remainder.channel;
  const double noise = remainder.noise.rms() * remainder.noise.rms();
  double signal = 0;  // axes of one quantity: nominal directions are known no better either
  for (const Channel& channel : block_.channels) {
    if (channel.unit != block_.channels[c].unit) continue;
    signal = std::max(signal, MeanSquare(channel.measured, final_mask_));
  }
  const double excess = MeanSquare(search.nothing.misfit.residual[c], final_mask_) - noise;
  return std::max(loud * loud * noise,
                  noise + kNominal * kNominal * signal + kForm * std::max(0.0, excess));
}

void Procedure::JudgeRemainder(const SearchResult& search, Remainder* remainder) const {
  const Series& residual = search.found.misfit.residual[remainder->channel];
  const double quiet = QuietOf(*remainder, search, kLoud);
  std::size_t loud_in_all = 0;
  for (const Manoeuvre& manoeuvre : manoeuvres_) {
    if (manoeuvre.axes == 0) continue;
    const std::size_t loud = MeanSquare(residual, manoeuvre.samples) > quiet ? 1 : 0;
    loud_in_all += loud;
    if (manoeuvre.part != Part::kFinal) continue;
    ++remainder->manoeuvres;
    remainder->loud += loud;
  }
  const double square = remainder->rmse * remainder->rmse;
  if (square <= quiet) return;
  const bool is_told =
      remainder->noise.at_rest || square > QuietOf(*remainder, search, kLoudWithoutRest);
  const bool is_of_most = 2 * remainder->loud >= remainder->manoeuvres;
  const bool is_of_several = remainder->loud > 0 && loud_in_all >= kSeveral &&
                             remainder->rmse > kMuchLouder * remainder->noise.rms();
  remainder->kind = !is_told                      ? Remainder::Kind::kUnknown
                    : is_of_most || is_of_several ? Remainder::Kind::kError
                                                  : Remainder::Kind::kOfFew;
}

void Procedure::FindRemainders(const SearchResult& search, BlockDiagnosis* out) const {
  const Mask not_final = Not(final_mask_);
  const Misfit free = LessFreeMember(block_, likelihood_, search.nothing.misfit, manoeuvres_);
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
    const Series& residual = search.found.misfit.residual[c];
    Remainder remainder;
    remainder.channel = c;
    remainder.rmse = std::sqrt(MeanSquare(residual, final_mask_));
    remainder.noise = NoiseLevelOf(block_, c, residual, not_final);
    for (const auto& one : GainsOf(likelihood_, search.nothing.misfit, free, select_, c)) {
      remainder.free_member_tells = remainder.free_member_tells || one.possible > 0;
    }
    JudgeRemainder(search, &remainder);
    out->remainders.push_back(remainder);
  }
}

/// The probability, by chance, of the free member following a channel's residual so steadily; none
/// where it does not. `ask_all`: by fits to other manoeuvres, which all of them are asked about
/// where what is left is loud and not told of yet: a second question, so that each counts twice.
std::optional<double> Procedure::FollowedP(const Misfit& misfit, const Misfit& free,
                                           const std::function<const Misfit&()>& ask_all,
                                           const Remainder& remainder) const {
  if (EffectOf(block_, free, misfit) < options_.least_effect) return std::nullopt;
  const auto p_over = [&](const Misfit& less, const std::vector<Segment>& pieces) {
    return SteadyGainP(GainsOf(likelihood_, misfit, less, pieces, remainder.channel));
  };
  const auto tests =
      static_cast<double>(std::max(options_.channels_in_all, block_.channels.size()));
  const double chosen_p = std::min(1.0, tests * p_over(free, select_));
  if (chosen_p <= options_.alpha && p_over(free, final_) <= kUnconfirmedP) return chosen_p;
  const bool is_open =
      remainder.kind == Remainder::Kind::kUnknown || remainder.kind == Remainder::Kind::kOfFew;
  if (!is_open) return std::nullopt;
  std::vector<Segment> all = seen_;
  all.insert(all.end(), final_.begin(), final_.end());
  const double p = std::min(1.0, 2 * tests * p_over(ask_all(), all));
  return p <= options_.alpha ? std::optional(p) : std::nullopt;
}

/// What is louder than noise, or what the free member still follows.
void Procedure::FindUnexplained(BlockDiagnosis* out) const {
  const SearchResult& search = out->search;
  const Misfit& misfit = search.found.misfit;
  const Misfit free = LessFreeMember(block_, likelihood_, misfit, manoeuvres_);
  std::optional<Misfit> crossed;
  const auto ask_all = [&]() -> const Misfit& {
    if (!crossed) crossed = LessUnseenFreeMember(block_, likelihood_, misfit, manoeuvres_);
    return *crossed;
  };
  for (const Remainder& remainder : out->remainders) {
    const std::size_t c = remainder.channel;
    double total = 0;
    for (const auto& one : GainsOf(likelihood_, misfit, free, select_, c)) total += one.gain;
    Unexplained left{{}, {}, 0, remainder.rmse, remainder.noise.rms()};
    left.share = std::max(0.0, total / std::max({search.free_gain, total, 1e-9}));
    if (left.share >= kLeastUnexplained) left.p = FollowedP(misfit, free, ask_all, remainder);
    if (!left.p && remainder.kind != Remainder::Kind::kError) continue;
    left.location = Locate(block_.channels[c], c, misfit.residual[c], likelihood_.noise()[c],
                           remainder.noise, stream_, options_.threads);
    out->unexplained.push_back(std::move(left));
  }
}

/// Whether a difference between two predictions would pass all that is seen and FINAL under most
/// draws of the noise. A draw's gain of log-likelihood is normal, of mean `possible` and twice its
/// variance.
bool Procedure::WouldBeSeen(const Misfit& difference) const {
  const Misfit none = [&] {
    Misfit out = difference;
    for (Eigen::VectorXd& innovation : out.innovation) innovation.setZero();
    return out;
  }();
  const std::size_t tests = std::max(options_.suspects_in_all, block_.suspects.size());
  const double alpha = options_.alpha / static_cast<double>(tests);
  const auto drawn = [&](const std::vector<Segment>& part, std::uint64_t first) {
    std::vector<ManoeuvreGain> gains = GainsOf(likelihood_, difference, none, part);
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * stream_.Gaussian(first++);
    }
    return gains;
  };
  std::uint64_t seen = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = (draw + 1) << 33;
    seen += GainP(drawn(seen_, first)) <= alpha &&
                    AreConfirming(drawn(final_, first + (std::uint64_t{1} << 32)), kUnconfirmedP)
                ? 1
                : 0;
  }
  return 4 * seen >= 3 * kDraws;
}

Detectability Procedure::DetectabilityOf(const Suspect& suspect) const {
  const auto nothing = block_.predict({});
  Detectability out{&suspect, {}};
  for (const std::vector<double>& start : suspect.starts) {
    const auto truth = block_.predict({{&suspect, start}});
    if (likelihood_.Discernible(nothing, truth) < kSeen) continue;
    const Misfit difference = likelihood_.JudgeAgainst(truth, nothing);
    Misfit none = difference;
    for (Series& residual : none.residual) {
      std::fill(residual.value.begin(), residual.value.end(), 0.0);
    }
    if (EffectOf(block_, difference, none) < options_.least_effect) continue;
    if (!WouldBeSeen(difference)) continue;
    out.smallest = start.empty() ? 1 : start[suspect.free.empty() ? 0 : suspect.free.front().index];
    break;
  }
  return out;
}

/// Parts what FINAL confirms from what it does not; what is confirmed is fitted anew on its own.
void Procedure::Confirm(BlockDiagnosis* out) const {
  Structure kept;
  std::vector<TermEvidence> evidence;
  std::vector<Finding> described =
      InParallel<Finding>(out->search.found.terms.size(), options_.threads,
                          [&](std::size_t t) { return Describe(out->search, t); });
  for (std::size_t t = 0; t < described.size(); ++t) {
    Finding& finding = described[t];
    if (finding.is_confirmed) {
      kept.push_back(finding.term);
      evidence.push_back(finding.evidence);
      out->findings.push_back(std::move(finding));
    } else {
      out->unconfirmed.push_back(std::move(finding));
    }
  }
  if (out->unconfirmed.empty()) return;
  out->search.found = fitter_.Determine(fitter_.FitFrom(kept));
  out->search.evidence = std::move(evidence);
  out->findings.clear();
  for (std::size_t t = 0; t < out->search.found.terms.size(); ++t) {
    out->findings.push_back(Describe(out->search, t));
  }
}

BlockDiagnosis Procedure::Untested() const {
  BlockDiagnosis out;
  out.is_testable = false;
  out.manoeuvres = manoeuvres_;
  out.noise = likelihood_.noise();
  out.search.nothing = out.search.found = fitter_.AsGiven({});
  for (const Suspect& suspect : block_.suspects) out.detectability.push_back({&suspect, {}});
  return out;
}

StructureSearch Procedure::SearchAfter(const EarlierSearch& earlier) const {
  return {block_, likelihood_.noise(), fitter_, manoeuvres_, options_, earlier};
}

BlockDiagnosis Procedure::Explain(SearchResult search) const {
  BlockDiagnosis out;
  out.manoeuvres = manoeuvres_;
  out.noise = likelihood_.noise();
  out.search = std::move(search);
  Confirm(&out);
  FindRemainders(out.search, &out);
  FindUnexplained(&out);
  out.detectability =
      InParallel<Detectability>(block_.suspects.size(), options_.threads,
                                [&](std::size_t s) { return DetectabilityOf(block_.suspects[s]); });
  for (std::size_t c = 0; c < block_.channels.size(); ++c) {
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
      search.TellApart(&last.search);
      return last;
    }
    last.noise = std::move(less);
    before = std::move(last.search);
    earlier = {&before, false};
  }
}

/// From what the block's beginning told, under the noise that there is beside it.
Searched SearchOn(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                  const std::vector<Manoeuvre>& manoeuvres, const SearchResult& begun) {
  std::vector<NoiseModel> noise = NoiseOfBlock(block, manoeuvres, begun.found.terms);
  const Procedure procedure(block, options, stream, manoeuvres, noise);
  StructureSearch search = procedure.SearchAfter({&begun, true});
  SearchResult found = search.Find();
  search.TellApart(&found);
  return {std::move(noise), std::move(found)};
}

Searched SearchFor(const ReplayBlock& block, const SearchOptions& options, const Stream& stream,
                   const std::vector<Manoeuvre>& manoeuvres) {
  const std::size_t enough = EnoughSamples(manoeuvres, block.period_s());
  const std::vector<Manoeuvre> first = Within(manoeuvres, enough);
  if (enough == block.samples() || !IsTestable(first)) {
    return SearchInTurn(block, options, stream, manoeuvres);
  }
  const ReplayBlock beginning = BeginningOf(block, enough);
  SearchResult begun = SearchInTurn(beginning, options, stream, first).search;
  return SearchOn(block, options, stream, manoeuvres, OnWhole(std::move(begun), beginning, block));
}

}  // namespace

std::vector<Manoeuvre> ManoeuvresOf(const ReplayBlock& block, const Stream& stream) {
  return SplitByManoeuvre(block.commands, {.longest_s = kLongest_s}, stream);
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
