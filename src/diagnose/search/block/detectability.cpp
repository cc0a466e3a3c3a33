#include "diagnose/search/block/detectability.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "diagnose/search/fit/steady_gain.h"
#include "diagnose/search/structure/effect_size.h"

namespace tera {
namespace {

/// Smallest noiseless gain in log-likelihood of a visible effect: the penalty of the criterion on
/// TRAIN, and the same on SELECT.
constexpr double kLeastGain = 20;
/// Noise draws; three quarters of them must show the candidate.
constexpr std::uint64_t kDraws = 20;

/// True if a difference between two predictions passes the tests in most noise draws. The gain in
/// log-likelihood of a draw is normal: its mean is the possible gain, its variance twice that.
bool WouldBeSeen(const EvaluationContext& context, const Misfit& difference) {
  Misfit none = difference;
  for (Eigen::VectorXd& innovation : none.innovation) innovation.setZero();
  const std::size_t tests =
      std::max(context.options.total_candidates, context.block.candidates.size());
  const double alpha = context.options.alpha / static_cast<double>(tests);
  const auto drawn = [&](const std::vector<Segment>& part, std::uint64_t first) {
    std::vector<ManoeuvreGain> gains = GainsOf(context.likelihood, difference, none, part);
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * context.stream.Gaussian(first++);
    }
    return gains;
  };
  std::uint64_t seen = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = (draw + 1) << 33;
    const std::uint64_t first_of_final = first + (std::uint64_t{1} << 32);
    seen += GainP(drawn(context.seen, first)) <= alpha &&
                    AreConfirming(drawn(context.final, first_of_final), kConfirmedP)
                ? 1
                : 0;
  }
  return 4 * seen >= 3 * kDraws;
}

}  // namespace

Detectability DetectabilityOf(const EvaluationContext& context, const Candidate& candidate) {
  const auto nothing = context.block.predict({});
  Detectability out{&candidate, {}};
  for (const std::vector<double>& start : candidate.starts) {
    const auto truth = context.block.predict({{&candidate, start}});
    if (context.likelihood.NoiselessGain(nothing, truth) < kLeastGain) continue;
    const Misfit difference = context.likelihood.EvaluateAgainst(truth, nothing);
    Misfit none = difference;
    for (Series& residual : none.residual) {
      std::fill(residual.value.begin(), residual.value.end(), 0.0);
    }
    if (EffectOf(context.block, difference, none) < kLeastTermEffect) continue;
    if (!WouldBeSeen(context, difference)) continue;
    out.smallest =
        start.empty() ? 1 : start[candidate.free.empty() ? 0 : candidate.free.front().index];
    break;
  }
  return out;
}

}  // namespace tera
