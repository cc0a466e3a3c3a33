#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/judged_block.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/fit/noise_level.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// What is left of a channel on FINAL with all that was found, beside its noise.
struct ResidualVerdict {
  std::size_t channel = 0;
  double rmse = 0;
  NoiseLevel noise;
  /// The flexible regressor predicts manoeuvres of TRAIN that it has not seen: it could show what
  /// is left.
  bool flexible_regressor_predicts = false;
  std::size_t manoeuvres = 0, loud = 0;  ///< of FINAL that move, and those louder than noise
  /// Noise, or what nominal numbers are off by; error of most manoeuvres, or of several in the
  /// whole recording, or of a few; unknown where
  /// it is louder than differences between samples say and the recording has no rest to tell.
  enum class Kind { kNoise, kUnknown, kOfFew, kError } kind = Kind::kNoise;
};

/// Error that no suspect takes away.
struct Unexplained {
  Location location;
  std::optional<double>
      p;             ///< of the flexible regressor gaining so steadily by chance, if it gains
  double share = 0;  ///< of the gain in likelihood that the flexible regressor had over nothing
  double rmse = 0;   ///< on FINAL
  double noise = 0;  ///< RMS of the channel's noise
};

/// What is left of each channel, and whether that is noise.
///
/// Model   noise is at most twice the channel's noise (noise_level.h), or adds to it no more than
///         3 % of the largest RMS among channels of its unit, the axes of one quantity, and 2 % of
///         the variance that was there beyond noise before anything was found. Error is what is
///         louder in half of the manoeuvres or more, or in one with three in the whole recording
///         and five times the noise in all. In a recording without rest, ten times the noise: noise
///         of AR(1), 0.995, is so much louder than its differences.
std::vector<ResidualVerdict> ResidualVerdictsOf(const JudgedBlock& judged,
                                                const SearchResult& search);

/// What no mechanism explains: what remains and is error, and what the flexible regressor still
/// follows.
///
/// Model   the flexible regressor follows a channel steadily over SELECT (Bonferroni over the
/// diagnosis's
///         channels) and FINAL, or, of what is loud in too few manoeuvres or may be noise, over all
///         of them, each by a fit to others, at half the level.
std::vector<Unexplained> UnexplainedOf(const JudgedBlock& judged, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& residual_verdicts);

}  // namespace tera
