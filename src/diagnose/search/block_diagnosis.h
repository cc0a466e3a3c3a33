#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "diagnose/search/locate.h"
#include "diagnose/search/structure_search.h"

namespace tera {

/// A number of a mechanism with its standard deviation.
struct ParameterEstimate {
  std::string name, unit;
  double value = 0;
  std::optional<double> sigma;  ///< none where it was not fitted, or the data do not hold it
};

/// One channel before and after, on samples that nothing was fitted to or chosen by.
struct HeldOutError {
  std::size_t channel = 0;
  double rmse_before = 0, rmse_after = 0;
  double excess_removed = 0;  ///< of the mean square above that of the noise
  double p = 1;               ///< of a gain this steady over blocks by chance
};

/// A mechanism that acts.
struct Finding {
  Term term;
  std::vector<ParameterEstimate> parameters;
  TermEvidence evidence;
  Location location;      ///< of the error that it leaves if it alone is left out
  HeldOutError held_out;  ///< without it, and with it
  /// 1 less the p of SELECT and FINAL, shared among the class: how sure it is that something of
  /// this class acts, not calibrated on cases of known cause.
  double confidence = 0;
};

/// Error that no suspect takes away.
struct Unexplained {
  Location location;
  double p = 1;
  double share = 0;  ///< of the gain in likelihood that the free member had over nothing
};

/// How small a suspect's main number may be and still be seen.
struct Detectability {
  const Suspect* suspect = nullptr;
  std::optional<double> smallest;  ///< none: not even the strongest start would be seen
};

struct BlockDiagnosis {
  std::vector<Manoeuvre> manoeuvres;
  std::vector<NoiseModel> noise;
  SearchResult search;
  std::vector<Finding> findings;
  /// What was found on TRAIN and SELECT and did not make FINAL any better.
  std::vector<Finding> unconfirmed;
  std::vector<Unexplained> unexplained;
  std::vector<Detectability> detectability;  ///< one a suspect
  std::vector<HeldOutError> confirmed;       ///< nothing against all findings, one a channel
};

/// Says why a block's measurements differ from its replay: noise, search, location, what remains,
/// what could not have been seen, and the error on data that was not used.
BlockDiagnosis DiagnoseBlock(const ReplayBlock& block, const SearchOptions& options,
                             const Stream& stream);

}  // namespace tera
