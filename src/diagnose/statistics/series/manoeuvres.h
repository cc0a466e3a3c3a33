#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

enum class Part { kTrain, kSelect, kFinal };

/// A run of samples in which the same commands are active.
struct Manoeuvre {
  Segment samples;
  std::uint64_t axes = 0;      ///< bit k: command k is active; 0: rest
  std::uint64_t backward = 0;  ///< bit k: command k is active and negative
  double amplitude = 0;        ///< largest |command| over all commands
  Part part = Part::kTrain;
};

/// Cuts a recording into manoeuvres by its commands, and assigns them to TRAIN (40 %), SELECT (30
/// %) and FINAL (30 %).
///
/// Model   in a manoeuvre, the same set of commands exceeds 2 % of full, each in one direction. It
///         includes 1 s of the rest after it. The remaining rest is a piece of its own. Runs under
///         0.5 s are joined to the previous one; runs over 3 s are cut into equal pieces. If this
///         gives fewer than 10 pieces, blocks of 5 s replace them.
///
///         Pieces with the same commands and directions, and with amplitudes in the same half, form
///         a stratum. In random order, each piece of a stratum goes to the part that lacks most of
///         its share, by number of pieces. Ties are decided by the shares over all moving, or all
///         resting, pieces.
/// Omits   effects of a manoeuvre on the next one beyond the rest.
///
/// Needs 1 to 64 commands of equal length without gaps. The pieces cover every sample, in order.
std::vector<Manoeuvre> SplitByManoeuvre(const std::vector<Series>& commands, const Stream& stream);

/// 1 for samples of `part`.
Mask MaskOf(const std::vector<Manoeuvre>& manoeuvres, Part part, std::size_t size);

}  // namespace tera
