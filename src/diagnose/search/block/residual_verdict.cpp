#include "diagnose/search/block/residual_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/effect_size.h"

namespace tera {
namespace {

/// Least share of its first gain that the flexible regressor must still have in an unexplained
/// channel.
constexpr double kLeastUnexplainedShare = 0.05;
/// Ratio of residual to noise RMS up to which a residual passes for noise.
constexpr double kLargestNoiseRatio = 2;
/// The same bound for a recording without rest, in which slow noise is unknown.
constexpr double kLargestNoiseRatioWithoutRest = 10;
/// Ratio of RMSE to noise above which few loud manoeuvres of the whole recording are error.
constexpr double kMuchLouder = 5;
constexpr std::size_t kFewestLoud = 3;  ///< loud manoeuvres of the whole recording for that
/// Share of a channel's RMS that errors of nominal numbers may leave.
constexpr double kNominalShare = 0.03;
/// Share of the excess variance that errors of a mechanism's form in the library may leave.
constexpr double kFormShare = 0.02;

/// Mean square up to which a residual passes for noise, errors of nominal numbers, and errors of a
/// mechanism's form in the library.
double QuietMeanSquare(const EvaluationContext& context, const SearchResult& search,
                       const ResidualVerdict& verdict, double loud) {
  const std::size_t c = verdict.channel;
  const double noise = verdict.noise.rms() * verdict.noise.rms();
  double signal = 0;  // over the axes of one quantity, since nominal directions are uncertain too
  for (const Channel& channel : context.block.channels) {
    if (channel.unit != context.block.channels[c].unit) continue;
    signal = std::max(signal, MeanSquare(channel.measured, context.final_mask));
  }
  const double excess = MeanSquare(search.nothing.misfit.residual[c], context.final_mask) - noise;
  return std::max(loud * loud * noise, noise + kNominalShare * kNominalShare * signal +
                                           kFormShare * std::max(0.0, excess));
}

/// Counts the loud manoeuvres and decides the verdict.
void Decide(const EvaluationContext& context, const SearchResult& search,
            ResidualVerdict* verdict) {
  const Series& residual = search.found.misfit.residual[verdict->channel];
  const double quiet = QuietMeanSquare(context, search, *verdict, kLargestNoiseRatio);
  std::size_t loud_in_all = 0;
  for (const Manoeuvre& manoeuvre : context.manoeuvres) {
    if (manoeuvre.axes == 0) continue;
    const std::size_t loud = MeanSquare(residual, manoeuvre.samples) > quiet ? 1 : 0;
    loud_in_all += loud;
    if (manoeuvre.part != Part::kFinal) continue;
    ++verdict->manoeuvres;
    verdict->loud += loud;
  }
  const double square = verdict->rmse * verdict->rmse;
  if (square <= quiet) return;
  const bool is_known =
      verdict->noise.at_rest ||
      square > QuietMeanSquare(context, search, *verdict, kLargestNoiseRatioWithoutRest);
  const bool is_of_most = 2 * verdict->loud >= verdict->manoeuvres;
  const bool is_of_several = verdict->loud > 0 && loud_in_all >= kFewestLoud &&
                             verdict->rmse > kMuchLouder * verdict->noise.rms();
  verdict->kind = !is_known                     ? ResidualVerdict::Kind::kUnknown
                  : is_of_most || is_of_several ? ResidualVerdict::Kind::kError
                                                : ResidualVerdict::Kind::kOfFew;
}

/// p-value of the flexible regressor's steady gain on a channel's residual; none if it has none.
/// `cross_fitted` gives the residual after fits to other manoeuvres. It serves a second test over
/// all manoeuvres if the residual is loud in few of them or may be slow noise. Its p-value is
/// doubled.
std::optional<double> FollowedP(const EvaluationContext& context, const Misfit& misfit,
                                const Misfit& beyond,
                                const std::function<const Misfit&()>& cross_fitted,
                                const ResidualVerdict& verdict) {
  if (EffectOf(context.block, beyond, misfit) < kLeastTermEffect) return std::nullopt;
  const auto p_over = [&](const Misfit& less, const std::vector<Segment>& pieces) {
    return SteadyGainP(GainsOf(context.likelihood, misfit, less, pieces, verdict.channel));
  };
  const auto tests =
      static_cast<double>(std::max(context.options.total_channels, context.block.channels.size()));
  const double chosen_p = std::min(1.0, tests * p_over(beyond, context.select));
  if (chosen_p <= context.options.alpha && p_over(beyond, context.final) <= kConfirmedP) {
    return chosen_p;
  }
  const bool is_open = verdict.kind == ResidualVerdict::Kind::kUnknown ||
                       verdict.kind == ResidualVerdict::Kind::kOfFew;
  if (!is_open) return std::nullopt;
  std::vector<Segment> all = context.seen;
  all.insert(all.end(), context.final.begin(), context.final.end());
  const double p = std::min(1.0, 2 * tests * p_over(cross_fitted(), all));
  return p <= context.options.alpha ? std::optional(p) : std::nullopt;
}

}  // namespace

std::vector<ResidualVerdict> ResidualVerdictsOf(const EvaluationContext& context,
                                                const SearchResult& search) {
  const Misfit& nothing = search.nothing.misfit;
  const Misfit beyond =
      ResidualBeyondFlexible(context.block, context.likelihood, nothing, context.manoeuvres);
  std::vector<ResidualVerdict> verdicts;
  for (std::size_t c = 0; c < context.block.channels.size(); ++c) {
    const Series& residual = search.found.misfit.residual[c];
    ResidualVerdict verdict;
    verdict.channel = c;
    verdict.rmse = std::sqrt(MeanSquare(residual, context.final_mask));
    verdict.noise = NoiseLevelOf(context.block, c, residual, context.seen_mask);
    for (const auto& one : GainsOf(context.likelihood, nothing, beyond, context.select, c)) {
      verdict.flexible_regressor_predicts = verdict.flexible_regressor_predicts || one.possible > 0;
    }
    Decide(context, search, &verdict);
    verdicts.push_back(verdict);
  }
  return verdicts;
}

std::vector<Unexplained> UnexplainedOf(const EvaluationContext& context, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& verdicts,
                                       const std::vector<double>& tolerated) {
  const Misfit& misfit = search.found.misfit;
  const Misfit beyond =
      ResidualBeyondFlexible(context.block, context.likelihood, misfit, context.manoeuvres);
  std::optional<Misfit> crossed;
  const auto cross_fitted = [&]() -> const Misfit& {
    if (!crossed) {
      crossed = CrossFittedResidual(context.block, context.likelihood, misfit, context.manoeuvres);
    }
    return *crossed;
  };
  std::vector<Unexplained> unexplained;
  for (const ResidualVerdict& verdict : verdicts) {
    const std::size_t c = verdict.channel;
    double total = 0;
    for (const auto& one : GainsOf(context.likelihood, misfit, beyond, context.select, c)) {
      total += one.gain;
    }
    Unexplained left{{}, {}, 0, verdict.rmse, verdict.noise.rms()};
    left.share = std::max(0.0, total / std::max({search.flexible_gain, total, 1e-9}));
    const double taken = MeanSquare(misfit.residual[c], context.final_mask) -
                         MeanSquare(beyond.residual[c], context.final_mask);
    const bool is_minded = tolerated[c] == 0 || taken >= tolerated[c] * tolerated[c];
    if (left.share >= kLeastUnexplainedShare && is_minded) {
      left.p = FollowedP(context, misfit, beyond, cross_fitted, verdict);
    }
    if (!left.p && verdict.kind != ResidualVerdict::Kind::kError) continue;
    left.location =
        Locate(context.block.channels[c], c, misfit.residual[c], context.likelihood.noise()[c],
               verdict.noise, context.stream, context.options.threads);
    unexplained.push_back(std::move(left));
  }
  return unexplained;
}

}  // namespace tera
