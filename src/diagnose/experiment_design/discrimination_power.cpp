#include "diagnose/experiment_design/discrimination_power.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "diagnose/search/fit/steady_gain.h"

namespace tera {
namespace {

constexpr std::uint64_t kDraws = 100;  ///< of the noise: power to five per cent

/// Whether noise, drawn once, lets the tests discriminate the pair of which these are the gains.
bool IsDiscriminated(const std::vector<ManoeuvreGain>& seen,
                     const std::vector<ManoeuvreGain>& final, bool is_class, double level) {
  if (!is_class) return GainP(seen) <= level && AreConfirming(final, kConfirmedP);
  double lead = 0;
  for (const ManoeuvreGain& gain : seen) lead += gain.gain;
  return SteadyGainP(seen) <= kRivalP && lead >= kRivalGain;
}

double PowerOf(const RivalPair& pair, bool is_class, ReplayBlock run,
               const std::vector<Manoeuvre>& manoeuvres, const NoiseModel& noise, double level,
               const Stream& stream) {
  const auto truth = run.predict(pair.truth);
  for (std::size_t k = 0; k < run.samples(); ++k) {
    if (run.channels[0].measured.valid[k]) run.channels[0].measured.value[k] = truth[0][k];
  }
  const std::vector<Segment> whole = SeenSegmentsOf(manoeuvres);
  Mask mask(run.samples(), 0);
  for (const Segment& samples : whole) {
    for (std::size_t k = samples.begin; k < samples.end; ++k) mask[k] = 1;
  }
  const Likelihood likelihood(run, {noise}, mask);
  const StructureFitter fitter(run, likelihood, whole);
  const Misfit wrong = fitter.FitValues(pair.alternative).misfit;
  Misfit right = wrong;
  right.innovation[0].setZero();
  const auto gains_over = [&](const std::vector<Segment>& segments) {
    return GainsOf(likelihood, wrong, right, PiecesOf(segments, run.period_s()));
  };
  const auto seen = gains_over(whole);
  const auto final = gains_over(SegmentsOf(manoeuvres, Part::kFinal));
  const auto drawn = [&](std::vector<ManoeuvreGain> gains, std::uint64_t first) {
    for (ManoeuvreGain& gain : gains) {
      gain.gain = gain.possible + std::sqrt(2 * gain.possible) * stream.Gaussian(first++);
    }
    return gains;
  };
  std::uint64_t discriminated = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t first = draw << 33;
    const std::uint64_t first_of_final = first + (std::uint64_t{1} << 32);
    discriminated +=
        IsDiscriminated(drawn(seen, first), drawn(final, first_of_final), is_class, level) ? 1 : 0;
  }
  return static_cast<double>(discriminated) / static_cast<double>(kDraws);
}

}  // namespace

double DiscriminationPower(const AmbiguitySet& set, const ReplayBlock& run, const NoiseModel& noise,
                           double level, const Stream& stream) {
  const auto manoeuvres = ManoeuvresOf(run, stream);
  if (!IsTestable(manoeuvres)) return 0;
  double power = 1;
  for (const RivalPair& pair : set.pairs) {
    power = std::min(power, PowerOf(pair, set.is_class, run, manoeuvres, noise, level, stream));
  }
  return power;
}

}  // namespace tera
