#pragma once

#include <cstdint>

#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Why the scans of a lidar, or the depths of a camera, differ from their simulation: what acts on
/// the sensor, and what of the scene differs.
///
/// Model   a scene that differs in a few places is believed before a sensor that differs
///         everywhere, if the sensor is right elsewhere; else the sensor comes first
///         (registration_search.h), and the scene is what still differs under what was found of it
///         (scene_comparison.h), twice in turn. Not judged: fewer than ten blocks of time, fewer
///         than 5 % of points that can be compared.
PerceptionDiagnosis DiagnoseScans(const RangeSource& source, std::uint64_t seed);

}  // namespace tera
