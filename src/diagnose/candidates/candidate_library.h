#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// Search range of a mechanism's parameter; fixed where both ends are equal.
struct NumberRange {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 0;
};

/// A user's choice of candidate mechanisms, which restricts or extends each block's own candidates.
struct CandidateLibrary {
  std::string file;
  std::vector<std::string> only;     ///< if not empty, the only admitted mechanisms
  std::vector<std::string> without;  ///< excluded mechanisms
  /// Mechanisms with ranges of their own. A mechanism outside a block's own candidates becomes a
  /// candidate wherever it can act.
  std::vector<std::pair<const Mechanism*, std::vector<NumberRange>>> ranges;
};

/// Reads strict YAML:
///
///     only: [dead_band, backlash]
///     without: [valve_curve]
///     candidates:
///       dead_band: {width: [0.02, 0.3], asymmetry: 0}
///
/// `suspects`, the former name of `candidates`, is read as well. Throws InputError with every
/// fault: an unknown identifier or number, a range that is empty or beyond the mechanism's own.
CandidateLibrary ReadCandidateLibrary(const std::filesystem::path& file);

bool Admits(const CandidateLibrary& library, std::string_view mechanism);

/// Sets the candidates of all blocks by a library, and moves their starts into the ranges. Throws
/// InputError for a mechanism outside a block's own candidates that lacks a range for a parameter
/// without default.
void ApplyLibrary(const CandidateLibrary& library, const MachineModel& model,
                  std::vector<ReplayBlock>* blocks);

/// Throws InputError where a library leaves no block any candidate.
void RequireCandidates(const CandidateLibrary& library, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
