#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/fit/noise_level.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// The residual of a channel on FINAL with all findings, and whether it is noise.
struct ResidualVerdict {
  std::size_t channel = 0;
  double rmse = 0;
  NoiseLevel noise;
  /// True if the flexible regressor predicts manoeuvres that its fit did not use. It can then show
  /// a remaining error.
  bool flexible_regressor_predicts = false;
  std::size_t manoeuvres = 0;  ///< number of commanded manoeuvres of FINAL
  std::size_t loud = 0;        ///< number of those whose residual exceeds noise
  enum class Kind {
    kNoise,    ///< noise, or errors of nominal numbers
    kUnknown,  ///< above noise by third differences; without rest, slow noise cannot be excluded
    kOfFew,    ///< error in few manoeuvres
    kError,    ///< error in most manoeuvres, or in several of the whole recording
  } kind = Kind::kNoise;
};

/// Changes of the prediction by mechanisms at the ends of their tolerances.
struct Tolerated {
  /// By mechanism, channel and sample.
  std::vector<std::vector<std::vector<double>>> changes;
  /// By channel: largest RMS change on FINAL by a rate factor, after a fit of the nuisance
  /// parameters.
  std::vector<double> rms;
};

/// Error that no candidate explains.
struct Unexplained {
  Location location;
  /// p-value of structure over a variable, or else of the flexible regressor's steady gain. Empty
  /// if neither is significant.
  std::optional<double> p;
  /// Larger gain of the two, over the flexible regressor's gain without any term.
  double share = 0;
  double rmse = 0;   ///< RMSE on FINAL
  double noise = 0;  ///< RMS of the channel's noise
};

/// Decides for each channel whether its residual is noise.
///
/// Model   A residual up to twice the channel's noise (noise_level.h) is noise. Without rest the
///         limit is ten times the noise: third differences underestimate AR(1) noise with
///         coefficient 0.983 by this factor. Two more errors are accepted: 3 % of the largest RMS
///         among channels of the same unit, and 2 % of the variance beyond noise without any term.
///
///         A manoeuvre whose residual exceeds this is loud. The residual is error if at least half
///         of FINAL's manoeuvres are loud. It is also error if its RMSE is five times the noise, at
///         least one manoeuvre of FINAL is loud, and at least three of the whole recording are.
std::vector<ResidualVerdict> ResidualVerdictsOf(const EvaluationContext& context,
                                                const SearchResult& search);

/// Errors that no mechanism explains: residuals with structure over a variable, residuals with the
/// verdict of error, and residuals that the flexible regressor predicts.
///
/// Model   Structure. A curve over a variable (twenty B-splines), or the simulated value times such
///         a curve, is cross-fitted: fitted to four fifths of the manoeuvres and judged on the
///         others. Two conditions make it structure. First, the manoeuvres gain from it (GainP;
///         Bonferroni over variables and the diagnosis's channels). Second, it is large where it
///         acts: each sample is weighted by the square of the change by the curve. Under these
///         weights, the energy that the curve removes must exceed accepted errors by 1.6 standard
///         deviations over manoeuvres. Accepted errors are the change by any mechanism at the end
///         of its tolerance, and errors of nominal numbers and of a mechanism's form. Both
///         conditions must hold again after mechanisms within tolerance are added that explain most
///         (MisfitOfExpectedBeside). The variable with the largest gain leads the location.
///
///         Flexible regressor. It predicts a channel if its gain is steady over SELECT (Bonferroni
///         over the diagnosis's channels) and over FINAL. A second test runs if few manoeuvres are
///         loud or the residual may be slow noise. It uses all manoeuvres, each with a fit to the
///         others, at half the level. A predicted error is reported only if its removal reduces the
///         error on FINAL by at least the tolerated error.
std::vector<Unexplained> UnexplainedOf(const EvaluationContext& context,
                                       const StructureFitter& fitter, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& verdicts,
                                       const Tolerated& tolerated);

}  // namespace tera
