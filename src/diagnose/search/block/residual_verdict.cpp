#include "diagnose/search/block/residual_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

constexpr double kLeastUnexplained = 0.05;
constexpr double kLoudWithoutRest = 10;
constexpr double kMuchLouder = 5;  ///< times the noise: error, if in several manoeuvres of all
constexpr std::size_t kSeveral = 3;
constexpr double kLoud = 2;        ///< times the noise: error, not noise
constexpr double kNominal = 0.03;  ///< of a channel's RMS: nominal numbers are known no better
constexpr double kForm = 0.02;     ///< of an excess: its form in the library is no better

/// What a mean square may be and still be noise, nominal numbers, and what the forms of mechanisms
/// that were found differ by from what they stand for.
double QuietOf(const JudgedBlock& judged, const SearchResult& search,
               const ResidualVerdict& verdict, double loud) {
  const std::size_t c = verdict.channel;
  const double noise = verdict.noise.rms() * verdict.noise.rms();
  double signal = 0;  // axes of one quantity: nominal directions are known no better either
  for (const Channel& channel : judged.block.channels) {
    if (channel.unit != judged.block.channels[c].unit) continue;
    signal = std::max(signal, MeanSquare(channel.measured, judged.final_mask));
  }
  const double excess = MeanSquare(search.nothing.misfit.residual[c], judged.final_mask) - noise;
  return std::max(loud * loud * noise,
                  noise + kNominal * kNominal * signal + kForm * std::max(0.0, excess));
}

/// Counts the manoeuvres that are louder than noise, and says what that makes of what is left.
void Judge(const JudgedBlock& judged, const SearchResult& search, ResidualVerdict* verdict) {
  const Series& residual = search.found.misfit.residual[verdict->channel];
  const double quiet = QuietOf(judged, search, *verdict, kLoud);
  std::size_t loud_in_all = 0;
  for (const Manoeuvre& manoeuvre : judged.manoeuvres) {
    if (manoeuvre.axes == 0) continue;
    const std::size_t loud = MeanSquare(residual, manoeuvre.samples) > quiet ? 1 : 0;
    loud_in_all += loud;
    if (manoeuvre.part != Part::kFinal) continue;
    ++verdict->manoeuvres;
    verdict->loud += loud;
  }
  const double square = verdict->rmse * verdict->rmse;
  if (square <= quiet) return;
  const bool is_told =
      verdict->noise.at_rest || square > QuietOf(judged, search, *verdict, kLoudWithoutRest);
  const bool is_of_most = 2 * verdict->loud >= verdict->manoeuvres;
  const bool is_of_several = verdict->loud > 0 && loud_in_all >= kSeveral &&
                             verdict->rmse > kMuchLouder * verdict->noise.rms();
  verdict->kind = !is_told                      ? ResidualVerdict::Kind::kUnknown
                  : is_of_most || is_of_several ? ResidualVerdict::Kind::kError
                                                : ResidualVerdict::Kind::kOfFew;
}

/// The probability, by chance, of the flexible regressor following a channel's residual so
/// steadily; none where it does not. `ask_all`: by fits to other manoeuvres, which all of them are
/// asked about where what is left is loud and not told of yet: a second question, so that each
/// counts twice.
std::optional<double> FollowedP(const JudgedBlock& judged, const Misfit& misfit, const Misfit& free,
                                const std::function<const Misfit&()>& ask_all,
                                const ResidualVerdict& verdict) {
  if (EffectOf(judged.block, free, misfit) < judged.options.least_effect) return std::nullopt;
  const auto p_over = [&](const Misfit& less, const std::vector<Segment>& pieces) {
    return SteadyGainP(GainsOf(judged.likelihood, misfit, less, pieces, verdict.channel));
  };
  const auto tests =
      static_cast<double>(std::max(judged.options.channels_in_all, judged.block.channels.size()));
  const double chosen_p = std::min(1.0, tests * p_over(free, judged.select));
  if (chosen_p <= judged.options.alpha && p_over(free, judged.final) <= kConfirmedP) {
    return chosen_p;
  }
  const bool is_open = verdict.kind == ResidualVerdict::Kind::kUnknown ||
                       verdict.kind == ResidualVerdict::Kind::kOfFew;
  if (!is_open) return std::nullopt;
  std::vector<Segment> all = judged.seen;
  all.insert(all.end(), judged.final.begin(), judged.final.end());
  const double p = std::min(1.0, 2 * tests * p_over(ask_all(), all));
  return p <= judged.options.alpha ? std::optional(p) : std::nullopt;
}

}  // namespace

std::vector<ResidualVerdict> ResidualVerdictsOf(const JudgedBlock& judged,
                                                const SearchResult& search) {
  const Misfit& nothing = search.nothing.misfit;
  const Misfit free =
      ResidualBeyondFlexible(judged.block, judged.likelihood, nothing, judged.manoeuvres);
  std::vector<ResidualVerdict> residual_verdicts;
  for (std::size_t c = 0; c < judged.block.channels.size(); ++c) {
    const Series& residual = search.found.misfit.residual[c];
    ResidualVerdict verdict;
    verdict.channel = c;
    verdict.rmse = std::sqrt(MeanSquare(residual, judged.final_mask));
    verdict.noise = NoiseLevelOf(judged.block, c, residual, judged.seen_mask);
    for (const auto& one : GainsOf(judged.likelihood, nothing, free, judged.select, c)) {
      verdict.flexible_regressor_predicts = verdict.flexible_regressor_predicts || one.possible > 0;
    }
    Judge(judged, search, &verdict);
    residual_verdicts.push_back(verdict);
  }
  return residual_verdicts;
}

std::vector<Unexplained> UnexplainedOf(const JudgedBlock& judged, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& residual_verdicts) {
  const Misfit& misfit = search.found.misfit;
  const Misfit free =
      ResidualBeyondFlexible(judged.block, judged.likelihood, misfit, judged.manoeuvres);
  std::optional<Misfit> crossed;
  const auto ask_all = [&]() -> const Misfit& {
    if (!crossed) {
      crossed = CrossFittedResidual(judged.block, judged.likelihood, misfit, judged.manoeuvres);
    }
    return *crossed;
  };
  std::vector<Unexplained> unexplained;
  for (const ResidualVerdict& verdict : residual_verdicts) {
    const std::size_t c = verdict.channel;
    double total = 0;
    for (const auto& one : GainsOf(judged.likelihood, misfit, free, judged.select, c)) {
      total += one.gain;
    }
    Unexplained left{{}, {}, 0, verdict.rmse, verdict.noise.rms()};
    left.share = std::max(0.0, total / std::max({search.flexible_gain, total, 1e-9}));
    if (left.share >= kLeastUnexplained) {
      left.p = FollowedP(judged, misfit, free, ask_all, verdict);
    }
    if (!left.p && verdict.kind != ResidualVerdict::Kind::kError) continue;
    left.location =
        Locate(judged.block.channels[c], c, misfit.residual[c], judged.likelihood.noise()[c],
               verdict.noise, judged.stream, judged.options.threads);
    unexplained.push_back(std::move(left));
  }
  return unexplained;
}

}  // namespace tera
