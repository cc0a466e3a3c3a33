#pragma once

#include <string>
#include <vector>

#include "core/types/effects.h"
#include "diagnose/search/fit/replay_block.h"

namespace tera {

/// What a sensor measures, by which the mechanisms are chosen that may act on it.
enum class MeasuredBy { kLidar, kDepthCamera, kColourCamera };

/// What may act on a whole lidar or camera: `extrinsic` and `clock_offset` of the sensors' table
/// (sensors/sensor_mechanisms.h); where it measures distances, `range_bias` and `scale` too. Ranges
/// are those of the table. All parameters are free.
///
/// Model   priors by unit: 0.3 m, 5 deg, 5 per cent, 1 s. A clock is looked for from up to 3 s, and
///         from the 18 s between GPS time and UTC, either way.
/// Omits   errors of single beams or pixels, drift, rolling shutter.
std::vector<Candidate> CandidatesOf(MeasuredBy kind, const std::string& sensor,
                                    const Effects& present);

}  // namespace tera
