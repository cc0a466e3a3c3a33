#include "diagnose/search/block/lost_commands.h"

#include <algorithm>
#include <cmath>

#include "diagnose/motion/residual_noise.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

/// Shorter holds can be a delay within tolerance, longer ones a broken connection.
constexpr double kShortest_s = 0.08, kLongest_s = 5;
constexpr double kDof = 5;
constexpr double kClear = 5;  ///< gain in log-likelihood beyond the choice among all intervals

constexpr std::size_t kFewestHolds = 3;
constexpr double kLeastOverEarly = 2, kLeastUnfollowed = 0.5, kLeastBesideOne = 0.5;
constexpr double kMostAtReversals = 0.9;  ///< share of holds; the share by chance is 1/2 to 2/3
/// Deviation from a held rate that shows a loss, in noise deviations.
constexpr double kVisible = 3;

double Deviance(double error, double noise) {
  return 0.5 * (kDof + 1) * std::log1p(error * error / (kDof * noise * noise));
}

/// Noise of a residual, robust against bursts.
HoldNoise NoiseOf(const Series& residual, double rms) {
  std::vector<NoiseChannel> channel(1);
  channel[0].least = channel[0].sigma = rms;
  ChannelResiduals residuals;
  for (const Segment& run : SegmentsOf(residual.valid)) {
    const auto values = residual.value.begin();
    residuals.by_segment.emplace_back(values + static_cast<std::ptrdiff_t>(run.begin),
                                      values + static_cast<std::ptrdiff_t>(run.end));
  }
  EstimateNoise({residuals}, &channel);
  return {rms, channel[0].inflation};
}

struct Lengths {
  std::size_t shortest, longest;
};

Lengths LengthsOf(double period_s) {
  return {std::max<std::size_t>(2, std::lround(kShortest_s / period_s)),
          std::max<std::size_t>(2, std::lround(kLongest_s / period_s))};
}

double Tried(const Series& series) {
  return static_cast<double>(series.size() * LengthsOf(series.period_s).longest);
}

double GainOf(const std::vector<Hold>& holds) {
  double gain = 0;
  for (const Hold& one : holds) gain += one.gain;
  return gain;
}

std::vector<double> Less(const Series& measured, const Series& residual) {
  std::vector<double> predicted = measured.value;
  for (std::size_t k = 0; k < predicted.size(); ++k) predicted[k] -= residual.value[k];
  return predicted;
}

double DevianceIn(const std::vector<Hold>& holds, const Series& residual, double noise) {
  double sum = 0;
  for (const Hold& hold : holds) {
    for (std::size_t k = hold.samples.begin; k < hold.samples.end; ++k) {
      if (residual.valid[k]) sum += Deviance(residual.value[k], noise);
    }
  }
  return sum;
}

/// Share of lost commands at times when a loss is visible: the prediction differs by `least` from
/// that of `length` samples earlier.
double ShareLost(const std::vector<Hold>& holds, const std::vector<double>& predicted, double least,
                 std::size_t length) {
  std::size_t seen = 0, would_be_seen = 0;
  for (std::size_t k = length; k < predicted.size(); ++k) {
    if (std::abs(predicted[k] - predicted[k - length]) > least) ++would_be_seen;
  }
  for (const Hold& hold : holds) {
    for (std::size_t k = hold.samples.begin; k < hold.samples.end; ++k) {
      if (std::abs(predicted[k] - predicted[hold.samples.begin]) > least) ++seen;
    }
  }
  return would_be_seen == 0
             ? 0
             : std::min(1.0, static_cast<double>(seen) / static_cast<double>(would_be_seen));
}

/// True if the prediction reverses where a hold begins: it moves by more than `least` in one
/// direction before, and in the other direction within the hold.
bool BeginsAtReversal(const Hold& hold, const std::vector<double>& predicted, double least) {
  const double held = predicted[hold.samples.begin];
  std::size_t before = hold.samples.begin;
  while (before > 0 && std::abs(predicted[before] - held) <= least) --before;
  double furthest = 0;
  for (std::size_t k = hold.samples.begin; k < hold.samples.end; ++k) {
    if (std::abs(predicted[k] - held) > std::abs(furthest)) furthest = predicted[k] - held;
  }
  return (held - predicted[before]) * furthest < 0;
}

/// The interval with the largest gain that begins (with `early`: ends) at a sample. Empty if none
/// gains.
Hold BestAt(const Series& residual, const std::vector<double>& predicted, const HoldNoise& noise,
            bool early, std::size_t at, const Lengths& lengths) {
  Hold best;
  double gain = 0;
  for (std::size_t n = 1; n <= lengths.longest; ++n) {
    if (early ? at < n : at + n > residual.size()) break;
    const std::size_t k = early ? at - n : at + n - 1;
    const double held = predicted[early ? std::min(at, residual.size() - 1) : at];
    if (residual.valid[k]) {
      gain += (Deviance(residual.value[k], noise.scale) -
               Deviance(residual.value[k] + predicted[k] - held, noise.scale)) /
              noise.inflation;
    }
    if (n < lengths.shortest || gain <= best.gain) continue;
    best = {early ? Segment{k, at} : Segment{at, at + n}, gain};
  }
  return best;
}

/// Gain of the holds after a single mechanism joins the findings, as fitted alone: the smallest
/// over mechanisms that gain on TRAIN and on SELECT.
double LeastGainBesideOne(const EvaluationContext& context, const SearchResult& search,
                          const HoldNoise& noise) {
  const Series& measured = context.block.channels.front().measured;
  double least = INFINITY;
  for (const SingleEvidence& single : search.singles) {
    Structure terms = search.found.terms;
    const bool is_found = std::any_of(terms.begin(), terms.end(), [&](const Term& term) {
      return term.candidate == single.candidate;
    });
    if (is_found || std::min(single.gain, single.held_out_gain) <= 0) continue;
    terms.push_back({single.candidate, single.values});
    const Misfit beside = context.likelihood.Evaluate(context.block.predict(terms));
    const Series& left = beside.residual.front();
    least = std::min(least, GainOf(HoldsOf(left, Less(measured, left), noise)));
  }
  return least;
}

}  // namespace

std::vector<Hold> HoldsOf(const Series& residual, const std::vector<double>& predicted,
                          const HoldNoise& noise, bool early) {
  const Lengths lengths = LengthsOf(residual.period_s);
  std::vector<Hold> promising;
  for (std::size_t at = 0; noise.scale > 0 && at < residual.size(); ++at) {
    Hold best = BestAt(residual, predicted, noise, early, at, lengths);
    if (best.gain > std::log(Tried(residual)) + kClear) promising.push_back(best);
  }
  std::stable_sort(promising.begin(), promising.end(),
                   [](const Hold& a, const Hold& b) { return a.gain > b.gain; });
  std::vector<Hold> holds;
  for (const Hold& one : promising) {
    const bool is_apart = std::all_of(holds.begin(), holds.end(), [&](const Hold& other) {
      return one.samples.end <= other.samples.begin || one.samples.begin >= other.samples.end;
    });
    if (is_apart) holds.push_back(one);
  }
  return holds;
}

Series WithHolds(Series residual, const std::vector<double>& predicted,
                 const std::vector<Hold>& holds) {
  for (const Hold& hold : holds) {
    for (std::size_t k = hold.samples.begin; k < hold.samples.end; ++k) {
      residual.value[k] += predicted[k] - predicted[hold.samples.begin];
    }
  }
  return residual;
}

std::optional<LostCommands> LostCommandsOf(const EvaluationContext& context,
                                           const SearchResult& search, double noise_rms,
                                           double tolerated) {
  const Series& residual = search.found.misfit.residual.front();
  const Series& measured = context.block.channels.front().measured;
  const std::vector<double> predicted = Less(measured, residual);
  const HoldNoise noise = NoiseOf(residual, noise_rms);
  LostCommands lost{HoldsOf(residual, predicted, noise)};
  if (lost.holds.size() < kFewestHolds ||
      GainOf(lost.holds) < kLeastOverEarly * GainOf(HoldsOf(residual, predicted, noise, true))) {
    return std::nullopt;
  }
  const auto reversals = std::count_if(lost.holds.begin(), lost.holds.end(), [&](const Hold& hold) {
    return BeginsAtReversal(hold, predicted, kVisible * noise_rms);
  });
  if (static_cast<double>(reversals) > kMostAtReversals * static_cast<double>(lost.holds.size())) {
    return std::nullopt;
  }
  const Misfit beyond = CrossFittedResidual(context.block, context.likelihood, search.found.misfit,
                                            context.manoeuvres);
  const Series& unfollowed = beyond.residual.front();
  const bool follows =
      DevianceIn(lost.holds, unfollowed, noise_rms) < DevianceIn(lost.holds, residual, noise_rms);
  if (follows && GainOf(HoldsOf(unfollowed, Less(measured, unfollowed), noise)) <
                     kLeastUnfollowed * GainOf(lost.holds)) {
    return std::nullopt;
  }
  if (LeastGainBesideOne(context, search, noise) < kLeastBesideOne * GainOf(lost.holds)) {
    return std::nullopt;
  }
  const Mask all(residual.size(), 1);
  lost.rmse_before = std::sqrt(MeanSquare(residual, all));
  lost.rmse_after = std::sqrt(MeanSquare(WithHolds(residual, predicted, lost.holds), all));
  const double taken = std::pow(lost.rmse_before, 2) - std::pow(lost.rmse_after, 2);
  if (taken < tolerated * tolerated) return std::nullopt;
  std::vector<double> lengths_s;
  double excess = 0;
  for (const Hold& hold : lost.holds) {
    lengths_s.push_back(static_cast<double>(hold.samples.size()) * residual.period_s);
    excess += hold.gain - std::log(Tried(residual));
  }
  std::sort(lost.holds.begin(), lost.holds.end(),
            [](const Hold& a, const Hold& b) { return a.samples.begin < b.samples.begin; });
  lost.p = std::exp(-excess);
  lost.period_s = Median(lengths_s);
  lost.probability = ShareLost(lost.holds, predicted, kVisible * noise_rms,
                               static_cast<std::size_t>(lost.period_s / residual.period_s));
  return lost;
}

}  // namespace tera
