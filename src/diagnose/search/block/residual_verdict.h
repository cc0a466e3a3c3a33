#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnose/search/block/evaluation_context.h"
#include "diagnose/search/block/locate.h"
#include "diagnose/search/fit/noise_level.h"
#include "diagnose/search/structure/structure_search.h"

namespace tera {

/// Residual of a channel on FINAL with all findings, and whether it is noise.
struct ResidualVerdict {
  std::size_t channel = 0;
  double rmse = 0;
  NoiseLevel noise;
  /// The flexible regressor predicts manoeuvres outside its fit, so that it could show a remaining
  /// error.
  bool flexible_regressor_predicts = false;
  std::size_t manoeuvres = 0;  ///< commanded manoeuvres of FINAL
  std::size_t loud = 0;        ///< of these, manoeuvres whose residual exceeds noise
  enum class Kind {
    kNoise,    ///< noise, or errors of nominal numbers
    kUnknown,  ///< louder than third differences; without rest, slow noise is not distinguishable
    kOfFew,    ///< error of few manoeuvres
    kError,    ///< error of most manoeuvres, or of several in the whole recording
  } kind = Kind::kNoise;
};

/// Changes of the prediction by mechanisms at the ends of their tolerances.
struct Tolerated {
  /// Change of each channel's prediction by each mechanism.
  std::vector<std::vector<std::vector<double>>> changes;
  /// Largest RMS on FINAL by a rate factor, of each channel, beyond nuisances.
  std::vector<double> rms;
};

/// Error that no candidate explains.
struct Unexplained {
  Location location;
  /// p-value of structure over a variable, or of the flexible regressor's steady gain; none if
  /// neither gains.
  std::optional<double> p;
  double share = 0;  ///< the larger gain of the two in likelihood, relative to the flexible
                     ///< regressor's without any term
  double rmse = 0;   ///< on FINAL
  double noise = 0;  ///< RMS of the channel's noise
};

/// The verdict on each channel's residual.
///
/// Model   a residual is noise up to twice the channel's noise (noise_level.h). An excess also
///         passes for noise up to 3 % of the largest RMS among channels of its unit, plus 2 % of
///         the variance beyond noise without any term. A residual is error if half of FINAL's
///         manoeuvres or more exceed that. It is error too if any of FINAL and three of the whole
///         recording do, with an RMSE of five times the noise. Without rest, the level is ten times
///         the noise: third differences underestimate AR(1) noise with a coefficient of 0.983 by so
///         much.
std::vector<ResidualVerdict> ResidualVerdictsOf(const EvaluationContext& context,
                                                const SearchResult& search);

/// Errors that no mechanism explains: residuals with structure over a variable, residuals with the
/// verdict of error, and residuals that the flexible regressor still predicts.
///
/// Model   structure: a curve over the variable (twenty B-splines), or the simulated value times
///         such a curve, is fitted to four fifths of the manoeuvres and judged on the others. It is
///         structure if the manoeuvres gain from it, steadily or clearly in several (GainP;
///         Bonferroni over variables and the diagnosis's channels), and if it is large where it
///         acts. Each sample weighs there by the square of what the curve changes. Under these
///         weights, the energy that the curve removes must exceed the change by any mechanism at
///         the end of its tolerance, and what nominal numbers and forms may leave, by 1.6 standard
///         deviations over manoeuvres. Both must hold again beside the mechanisms within tolerance
///         that explain most (MisfitOfExpectedBeside). The variable with the largest gain leads the
///         location. The flexible regressor predicts a channel if its gain is steady over SELECT
///         (Bonferroni over the diagnosis's channels) and FINAL. All manoeuvres are tested too,
///         each by a fit to the others, if few are loud or the residual may be slow noise. The
///         latter test is at half the level. A predicted error is reported only if it reduces
///         FINAL's error by at least what is tolerated.
std::vector<Unexplained> UnexplainedOf(const EvaluationContext& context,
                                       const StructureFitter& fitter, const SearchResult& search,
                                       const std::vector<ResidualVerdict>& verdicts,
                                       const Tolerated& tolerated);

}  // namespace tera
