#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/fit/noise_level.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// What is left of a channel on FINAL with all that was found, and whether it is noise.
struct ResidualVerdict {
  std::size_t channel = 0;
  double rmse = 0;
  NoiseLevel noise;
  /// The flexible regressor predicts manoeuvres that it was not fitted to, so that it could show an
  /// error that is left.
  bool flexible_regressor_predicts = false;
  std::size_t manoeuvres = 0;  ///< commanded ones of FINAL
  std::size_t loud = 0;        ///< of these, the ones whose residual is louder than noise
  enum class Kind {
    kNoise,    ///< noise, or what nominal numbers are off by
    kUnknown,  ///< louder than differences between samples say, without rest to tell slow noise
    kOfFew,    ///< error of few manoeuvres
    kError,    ///< error of most manoeuvres, or of several in the whole recording
  } kind = Kind::kNoise;
};

/// Error that no candidate takes away.
struct Unexplained {
  Location location;
  /// Probability, by chance, of the flexible regressor's gain being so steady; none where it does
  /// not gain.
  std::optional<double> p;
  double share = 0;  ///< of the gain in likelihood that the flexible regressor had over nothing
  double rmse = 0;   ///< on FINAL
  double noise = 0;  ///< RMS of the channel's noise
};

/// The verdict on each channel's residual.
///
/// Model   noise is at most twice the channel's noise (noise_level.h), or adds to it no more than
///         3 % of the largest RMS among channels of its unit, the axes of one quantity, and 2 % of
///         the variance that was there beyond noise before anything was found. Error is what is
///         louder in half of the manoeuvres or more, or in one of FINAL where three of the whole
///         recording are louder and the RMSE is five times the noise. In a recording without rest,
///         error is ten times the noise, which third differences alone then tell: AR(1) noise with
///         a coefficient of 0.983 is so much louder than they say.
std::vector<ResidualVerdict> ResidualVerdictsOf(const EvaluationContext& context,
                                                const SearchResult& search);

/// What no mechanism explains: residuals that are error, and those that the flexible regressor
/// still follows.
///
/// Model   the flexible regressor follows a channel steadily over SELECT (Bonferroni over the
///         diagnosis's channels) and FINAL. Where what is left is loud in too few manoeuvres or may
///         be noise, it is also asked over all manoeuvres, each by a fit to others, at half the
///         level. As of a finding, what it follows is told only if it takes as much error on FINAL
///         as is `tolerated` of the channel.
std::vector<Unexplained> UnexplainedOf(const EvaluationContext& context, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& verdicts,
                                       const std::vector<double>& tolerated);

}  // namespace tera
