#include "diagnose/search/block/detectability.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

/// Gain in log-likelihood: what the criterion asks for on TRAIN, and as much of SELECT.
constexpr double kSeen = 20;
constexpr std::uint64_t kDraws = 20;  ///< of noise, of which three quarters are to show a suspect

/// Whether a difference between two predictions would pass all that is seen and FINAL under most
/// draws of the noise. A draw's gain of log-likelihood is normal, of mean `possible` and twice its
/// variance.
bool WouldBeSeen(const JudgedBlock& judged, const Misfit& difference) {
  Misfit none = difference;
  for (Eigen::VectorXd& innovation : none.innovation) innovation.setZero();
  const std::size_t tests = std::max(judged.options.suspects_in_all, judged.block.suspects.size());
  const double alpha = judged.options.alpha / static_cast<double>(tests);
  const auto drawn = [&](const std::vector<Segment>& part, std::uint64_t first) {
    std::vector<ManoeuvreGain> gains = GainsOf(judged.likelihood, difference, none, part);
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * judged.stream.Gaussian(first++);
    }
    return gains;
  };
  std::uint64_t seen = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = (draw + 1) << 33;
    const std::uint64_t first_of_final = first + (std::uint64_t{1} << 32);
    seen += GainP(drawn(judged.seen, first)) <= alpha &&
                    AreConfirming(drawn(judged.final, first_of_final), kConfirmedP)
                ? 1
                : 0;
  }
  return 4 * seen >= 3 * kDraws;
}

}  // namespace

Detectability DetectabilityOf(const JudgedBlock& judged, const Suspect& suspect) {
  const auto nothing = judged.block.predict({});
  Detectability out{&suspect, {}};
  for (const std::vector<double>& start : suspect.starts) {
    const auto truth = judged.block.predict({{&suspect, start}});
    if (judged.likelihood.Discernible(nothing, truth) < kSeen) continue;
    const Misfit difference = judged.likelihood.JudgeAgainst(truth, nothing);
    Misfit none = difference;
    for (Series& residual : none.residual) {
      std::fill(residual.value.begin(), residual.value.end(), 0.0);
    }
    if (EffectOf(judged.block, difference, none) < judged.options.least_effect) continue;
    if (!WouldBeSeen(judged, difference)) continue;
    out.smallest = start.empty() ? 1 : start[suspect.free.empty() ? 0 : suspect.free.front().index];
    break;
  }
  return out;
}

}  // namespace tera
