#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

namespace tera {

/// The range in which a number of a mechanism is looked for; held where both ends are the same.
struct NumberRange {
  std::size_t index = 0;  ///< among the mechanism's parameters
  double lower = 0, upper = 0;
};

/// A user's choice of candidate mechanisms. It limits or extends the candidates that blocks have by
/// themselves.
struct CandidateLibrary {
  std::string file;
  std::vector<std::string> only;     ///< no other mechanism is a candidate, where there are any
  std::vector<std::string> without;  ///< mechanisms that are no candidates
  /// Mechanisms with ranges of their own. One that is no candidate of a block by itself becomes one
  /// wherever it can act.
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

/// Whether a library leaves a mechanism among the candidates.
bool Admits(const CandidateLibrary& library, std::string_view mechanism);

/// Gives blocks the candidates of a library. The starts of a candidate are brought within the
/// ranges. Throws InputError where a mechanism that is no candidate of a block by itself lacks a
/// range for a number without default.
void ApplyLibrary(const CandidateLibrary& library, const MachineModel& model,
                  std::vector<ReplayBlock>* blocks);

/// Throws InputError where a library left none of the blocks a candidate.
void RequireCandidates(const CandidateLibrary& library, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
