#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// Search range of a mechanism's parameter. Equal ends hold it fixed.
struct NumberRange {
  std::size_t index = 0;  ///< index of the parameter in the mechanism
  double lower = 0, upper = 0;
};

/// The user's choice of candidate mechanisms, which restricts or extends the candidates of each
/// block.
struct CandidateLibrary {
  std::string file;
  std::vector<std::string> only;  ///< if not empty, only these mechanisms are candidates
  std::vector<std::string> without;
  /// Mechanisms with the user's ranges. Such a mechanism becomes a candidate of each block in which
  /// it can act.
  std::vector<std::pair<const Mechanism*, std::vector<NumberRange>>> ranges;
};

/// Reads strict YAML:
///
///     only: [dead_band, backlash]
///     without: [valve_curve]
///     candidates:
///       dead_band: {width: [0.02, 0.3], asymmetry: 0}
///
/// The key `suspects` is a synonym of `candidates`. Throws InputError with all faults: an unknown
/// identifier or number, a range that is empty or exceeds that of the mechanism.
CandidateLibrary ReadCandidateLibrary(const std::filesystem::path& file);

bool Admits(const CandidateLibrary& library, std::string_view mechanism);

/// Applies a library to the candidates of all blocks, and moves their starts into the ranges.
/// Throws InputError for a new candidate that has neither a range nor a default for one of its
/// parameters.
void ApplyLibrary(const CandidateLibrary& library, const MachineModel& model,
                  std::vector<ReplayBlock>* blocks);

/// Throws InputError if no block has a candidate.
void RequireCandidates(const CandidateLibrary& library, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
