#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// The compared kind of data of a sensor.
enum class ComparedBy { kRanges, kPictures };

/// Candidate effects on a whole perception sensor: `extrinsic` and `clock_offset` of the sensors'
/// table (sensors/sensor_mechanisms.h); for ranges also `range_bias` and `scale`, if the kind has
/// them. Parameter ranges are those of the table, and all parameters are free.
///
/// Model   priors by unit: 0.3 m, 5 deg, 5 per cent, 1 s. Clock offsets are searched up to 3 s, and
///         around the 18 s between GPS time and UTC, in either direction.
/// Omits   errors of single beams or pixels, drift, rolling shutter.
std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present);

}  // namespace tera
