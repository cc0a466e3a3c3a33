#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// What of a sensor is compared with a scene.
enum class ComparedBy { kRanges, kPictures };

/// What may act on a whole sensor of a kind that sees: `extrinsic` and `clock_offset` of the
/// sensors' table (sensors/sensor_mechanisms.h); where ranges are compared, `range_bias` and
/// `scale` too, if the kind has them. Ranges of numbers are those of the table. All parameters are
/// free.
///
/// Model   priors by unit: 0.3 m, 5 deg, 5 per cent, 1 s. A clock is looked for from up to 3 s, and
///         from the 18 s between GPS time and UTC, either way.
/// Omits   errors of single beams or pixels, drift, rolling shutter.
std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present);

}  // namespace tera
