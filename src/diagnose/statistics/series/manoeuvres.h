#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "diagnose/statistics/series/series.h"

namespace tera {

enum class Part { kTrain, kSelect, kFinal };

/// A run of samples with one set of commands.
struct Manoeuvre {
  Segment samples;
  std::uint64_t axes = 0;      ///< bit k: command k was given; 0: rest
  std::uint64_t backward = 0;  ///< bit k: command k was given, below 0
  double amplitude = 0;        ///< largest |command| over the axes
  Part part = Part::kTrain;
};

/// Cuts a recording into manoeuvres by its commands, and assigns them to TRAIN (40 %), SELECT (30
/// %) and FINAL (30 %).
///
/// Model   a manoeuvre is a run in which the same set of commands exceeds 2 % of full, each in a
///         single direction. It includes 1 s of the following rest. The remaining rest is a piece
///         of its own. Runs under 0.5 s are joined to the previous one; those over 3 s are cut into
///         equal pieces. With fewer than 10 such pieces: blocks of 5 s. Pieces with the same axes,
///         directions and half of amplitudes form a stratum. Within each, in random order, a piece
///         goes to the part that is furthest below its share of the stratum. Ties are resolved by
///         the shares over all moving, or all resting, pieces. Shares are by number.
/// Omits   effects of a manoeuvre on the next one beyond the tail.
///
/// Needs at least one command and at most 64, of equal length, with gaps bridged. The pieces cover
/// every sample, in order.
std::vector<Manoeuvre> SplitByManoeuvre(const std::vector<Series>& commands, const Stream& stream);

/// 1 for the samples that belong to `part`.
Mask MaskOf(const std::vector<Manoeuvre>& manoeuvres, Part part, std::size_t size);

}  // namespace tera
