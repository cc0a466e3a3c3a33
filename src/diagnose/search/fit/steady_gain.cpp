#include "diagnose/search/fit/steady_gain.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace tera {
namespace {

constexpr double kLeastPossible = 2;  ///< gain in log-likelihood below which a piece is ignored
/// Far above this possible gain in log-likelihood, the scatter by noise is negligible.
constexpr double kNoiseGain = 20;
constexpr std::size_t kFewest = 3;  ///< pieces, for a t statistic
/// Log of the largest factor by which one piece multiplies a bet.
constexpr double kMostGainOfBet = 2.25;
/// p up to which a bet confirms. Three clear gains reach 2 exp(-3 * 2.25), which is smaller.
constexpr double kConfirmingBetP = 0.01;
constexpr double kShortestPiece_s = 1;
constexpr std::size_t kFewestPieceSamples = 5;

/// One-sided Student's t of `amount` over the pieces.
template <typename Amount>
double SteadyShareP(const std::vector<ManoeuvreGain>& gains, Amount amount) {
  std::vector<double> share;
  double mean = 0;
  for (const ManoeuvreGain& one : gains) {
    if (one.possible < kLeastPossible) continue;
    share.push_back(amount(one) / std::sqrt(one.possible * (one.possible + kNoiseGain)));
    mean += share.back();
  }
  const auto count = static_cast<double>(share.size());
  if (share.size() < kFewest) return 1;
  mean /= count;
  double square = 0;
  for (const double s : share) square += (s - mean) * (s - mean);
  const double error = std::sqrt(square / (count - 1) / count);
  if (error <= 0) return mean > 0 ? 0 : 1;
  return boost::math::cdf(
      boost::math::complement(boost::math::students_t(count - 1), mean / error));
}

}  // namespace

std::vector<ManoeuvreGain> GainsOf(const Likelihood& likelihood, const Misfit& before,
                                   const Misfit& after, const std::vector<Segment>& manoeuvres,
                                   std::optional<std::size_t> channel) {
  std::vector<ManoeuvreGain> gains;
  for (const Segment& manoeuvre : manoeuvres) {
    ManoeuvreGain gain;
    gain.gain =
        likelihood.Sum(after, manoeuvre, channel) - likelihood.Sum(before, manoeuvre, channel);
    for (std::size_t c = 0; c < after.innovation.size(); ++c) {
      if (channel && c != *channel) continue;
      const double dof = likelihood.noise()[c].dof;
      for (std::size_t k = manoeuvre.begin; k < manoeuvre.end; ++k) {
        if (!likelihood.rows(c)[k]) continue;
        const auto row = static_cast<Eigen::Index>(k);
        gain.possible -= LogDensityOf(after.innovation[c][row] - before.innovation[c][row], dof);
      }
    }
    gains.push_back(gain);
  }
  return gains;
}

std::vector<Segment> PiecesOf(const std::vector<Segment>& manoeuvres, double period_s) {
  const auto shortest = std::max(
      kFewestPieceSamples, static_cast<std::size_t>(std::lround(kShortestPiece_s / period_s)));
  std::vector<Segment> pieces;
  for (const Segment& whole : manoeuvres) {
    const std::size_t count = std::max<std::size_t>(1, whole.size() / shortest);
    for (std::size_t p = 0; p < count; ++p) {
      pieces.push_back(
          {whole.begin + p * whole.size() / count, whole.begin + (p + 1) * whole.size() / count});
    }
  }
  return pieces;
}

double SteadyGainP(const std::vector<ManoeuvreGain>& gains) {
  return SteadyShareP(gains, [](const ManoeuvreGain& one) { return one.gain; });
}

double SteadyEffectP(const std::vector<ManoeuvreGain>& gains) {
  return SteadyShareP(gains, [](const ManoeuvreGain& one) { return one.gain + one.possible; });
}

double GainP(const std::vector<ManoeuvreGain>& gains) {
  double log_wealth = 0;
  for (const auto& [gain, possible] : gains) {
    if (possible >= kLeastPossible) log_wealth += std::min(gain, kMostGainOfBet);
  }
  return std::min(SteadyGainP(gains), 2 * std::exp(-log_wealth));
}

bool AreConfirming(const std::vector<ManoeuvreGain>& gains, double steady_level) {
  return SteadyGainP(gains) <= steady_level || GainP(gains) <= kConfirmingBetP;
}

std::vector<Segment> SegmentsOf(const std::vector<Manoeuvre>& manoeuvres, Part part) {
  std::vector<Segment> segments;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part == part) segments.push_back(manoeuvre.samples);
  }
  return segments;
}

std::vector<Segment> SeenSegmentsOf(const std::vector<Manoeuvre>& manoeuvres) {
  std::vector<Segment> segments;
  for (const Manoeuvre& manoeuvre : manoeuvres) {
    if (manoeuvre.part != Part::kFinal) segments.push_back(manoeuvre.samples);
  }
  return segments;
}

}  // namespace tera
