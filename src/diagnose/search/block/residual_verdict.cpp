#include "diagnose/search/block/residual_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/search/block/expected_instead.h"
#include "diagnose/search/fit/flexible_regressor.h"
#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/effect_size.h"
#include "diagnose/statistics/regime/partialling.h"
#include "diagnose/statistics/series/robust.h"

namespace tera {
namespace {

/// In an unexplained channel, the flexible regressor keeps at least this share of its gain without
/// any term.
constexpr double kLeastUnexplainedShare = 0.05;
/// Ratio of residual to noise RMS up to which a residual is noise.
constexpr double kLargestNoiseRatio = 2;
/// The same without rest, where slow noise is unknown.
constexpr double kLargestNoiseRatioWithoutRest = 10;
/// Ratio of RMSE to noise above which few loud manoeuvres of the whole recording are error.
constexpr double kMuchLouder = 5;
constexpr std::size_t kFewestLoud = 3;  ///< number of such loud manoeuvres
/// Share of a channel's RMS that errors of nominal numbers may leave.
constexpr double kNominalShare = 0.03;
/// Share of the excess variance that an imperfect form of a mechanism may leave.
constexpr double kFormShare = 0.02;

/// Mean square up to which a residual counts as noise, including errors of nominal numbers and of a
/// mechanism's form.
double QuietMeanSquare(const EvaluationContext& context, const SearchResult& search,
                       const ResidualVerdict& verdict, double loud) {
  const std::size_t c = verdict.channel;
  const double noise = verdict.noise.rms() * verdict.noise.rms();
  // Largest over the axes of one quantity, because nominal directions are uncertain too.
  double signal = 0;
  for (const Channel& channel : context.block.channels) {
    if (channel.unit != context.block.channels[c].unit) continue;
    signal = std::max(signal, MeanSquare(channel.measured, context.final_mask));
  }
  const double excess = MeanSquare(search.nothing.misfit.residual[c], context.final_mask) - noise;
  return std::max(loud * loud * noise, noise + kNominalShare * kNominalShare * signal +
                                           kFormShare * std::max(0.0, excess));
}

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

double SumOf(const std::vector<ManoeuvreGain>& gains) {
  double sum = 0;
  for (const ManoeuvreGain& one : gains) sum += one.gain;
  return sum;
}

/// p-value of the flexible regressor's steady gain on a channel's residual; none without
/// significance. `cross_fitted` gives the residual after fits to other manoeuvres, for a second
/// test over all manoeuvres with a doubled p-value. It runs if few manoeuvres are loud or the
/// residual may be slow noise.
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

/// Energy of a series in each manoeuvre. Each sample is weighted by the square of what a curve
/// removes.
class WeightedEnergies {
 public:
  WeightedEnergies(const std::vector<Manoeuvre>& manoeuvres, const Series& before,
                   const Series& after)
      : manoeuvres_(manoeuvres), weight_(before.size(), 0.0) {
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (before.valid[k]) weight_[k] = std::pow(before.value[k] - after.value[k], 2);
    }
  }
  Eigen::VectorXd Of(const std::vector<double>& values) const {
    return Sum([&](std::size_t k) { return values[k] * values[k]; });
  }
  Eigen::VectorXd OfOne() const {
    return Sum([](std::size_t) { return 1.0; });
  }

 private:
  template <typename Square>
  Eigen::VectorXd Sum(Square square) const {
    Eigen::VectorXd sums(static_cast<Eigen::Index>(manoeuvres_.size()));
    for (std::size_t m = 0; m < manoeuvres_.size(); ++m) {
      double sum = 0;
      const Segment& samples = manoeuvres_[m].samples;
      for (std::size_t k = samples.begin; k < samples.end; ++k) {
        if (weight_[k] > 0) sum += weight_[k] * square(k);
      }
      sums[static_cast<Eigen::Index>(m)] = sum;
    }
    return sums;
  }

  const std::vector<Manoeuvre>& manoeuvres_;
  std::vector<double> weight_;
};

/// True if the error that `beyond` removes from `misfit` is significantly larger, where it acts,
/// than mechanisms within tolerance, nominal numbers and mechanisms' forms may leave.
bool IsLargeWhereItActs(const EvaluationContext& context, const SearchResult& search,
                        const Tolerated& tolerated, const ResidualVerdict& verdict,
                        const Misfit& misfit, const Misfit& beyond) {
  const std::size_t c = verdict.channel;
  const WeightedEnergies energies(context.manoeuvres, misfit.residual[c], beyond.residual[c]);
  Eigen::VectorXd accepted = 0 * energies.OfOne();
  const auto accept = [&](const Eigen::VectorXd& energy) {
    if (energy.sum() > accepted.sum()) accepted = energy;
  };
  for (const auto& change : tolerated.changes) accept(energies.Of(change[c]));
  for (const Channel& channel : context.block.channels) {
    if (channel.unit != context.block.channels[c].unit) continue;
    accept(kNominalShare * kNominalShare * energies.Of(channel.measured.value));
  }
  const double noise = verdict.noise.rms() * verdict.noise.rms();
  const Eigen::VectorXd excess =
      energies.Of(search.nothing.misfit.residual[c].value) - noise * energies.OfOne();
  accepted += kFormShare * excess.cwiseMax(0.0);
  const Eigen::VectorXd more =
      energies.Of(misfit.residual[c].value) - energies.Of(beyond.residual[c].value) - accepted;
  return more.sum() > kOneSided95 * more.norm();
}

/// The variable over which a channel's residual has most structure. None without structure.
std::optional<LeadingVariable> StructureOf(const EvaluationContext& context,
                                           const SearchResult& search, const Tolerated& tolerated,
                                           const ResidualVerdict& verdict, const Misfit& misfit) {
  const std::size_t c = verdict.channel;
  const std::vector<RegimeVariable> variables =
      VariablesAndShares(context.block.channels[c], misfit.residual[c]);
  std::vector<Segment> manoeuvres;
  for (const Manoeuvre& one : context.manoeuvres) manoeuvres.push_back(one.samples);
  const auto tests = static_cast<double>(
      std::max(context.options.total_channels, context.block.channels.size()) * variables.size());
  std::optional<LeadingVariable> leading;
  double most = 0;
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const Misfit beyond = CrossFittedOver(KnownColumns(RegimeAxis(variables[v])), c,
                                          context.likelihood, misfit, context.manoeuvres);
    const auto gains = GainsOf(context.likelihood, misfit, beyond, manoeuvres, c);
    const double gain = SumOf(gains);
    const double p = std::min(1.0, tests * GainP(gains));
    if (gain <= most || p > context.options.alpha) continue;
    if (!IsLargeWhereItActs(context, search, tolerated, verdict, misfit, beyond)) continue;
    most = gain;
    leading = {v, p, SumOf(GainsOf(context.likelihood, misfit, beyond, context.select, c))};
  }
  return leading;
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

std::vector<Unexplained> UnexplainedOf(const EvaluationContext& context,
                                       const StructureFitter& fitter, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& verdicts,
                                       const Tolerated& tolerated) {
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
  std::optional<Misfit> expected;
  const auto structure_of = [&](const ResidualVerdict& verdict) {
    auto leading = StructureOf(context, search, tolerated, verdict, misfit);
    if (!leading) return leading;
    if (!expected) expected = MisfitOfExpectedBeside(context.block, fitter, search.found);
    return StructureOf(context, search, tolerated, verdict, *expected);
  };
  std::vector<Unexplained> unexplained;
  for (const ResidualVerdict& verdict : verdicts) {
    const std::size_t c = verdict.channel;
    const double total = SumOf(GainsOf(context.likelihood, misfit, beyond, context.select, c));
    Unexplained left{{}, {}, 0, verdict.rmse, verdict.noise.rms()};
    const auto share_of = [&](double gain) {
      return std::max(0.0, gain / std::max({search.flexible_gain, gain, 1e-9}));
    };
    left.share = share_of(total);
    const double taken = MeanSquare(misfit.residual[c], context.final_mask) -
                         MeanSquare(beyond.residual[c], context.final_mask);
    const bool is_minded = tolerated.rms[c] == 0 || taken >= tolerated.rms[c] * tolerated.rms[c];
    if (left.share >= kLeastUnexplainedShare && is_minded) {
      left.p = FollowedP(context, misfit, beyond, cross_fitted, verdict);
    }
    const std::optional<LeadingVariable> structure = structure_of(verdict);
    if (structure) {
      left.p = std::min(left.p.value_or(1), structure->p);
      left.share = std::max(left.share, share_of(structure->gain));
    }
    if (!left.p && verdict.kind != ResidualVerdict::Kind::kError) continue;
    left.location =
        Locate(context.block.channels[c], c, misfit.residual[c], context.likelihood.noise()[c],
               verdict.noise, context.stream, context.options.threads, structure);
    unexplained.push_back(std::move(left));
  }
  return unexplained;
}

}  // namespace tera
