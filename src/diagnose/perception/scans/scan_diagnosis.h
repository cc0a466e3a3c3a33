#pragma once

#include <cstdint>

#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Diagnoses differences between a lidar's scans, or a depth camera's images, and their simulation:
/// effects on the sensor, and differences of the scene.
///
/// Model   a scene that differs in a few places is preferred to a sensor that differs everywhere,
///         if the sensor is right elsewhere. Otherwise the sensor comes first
///         (registration_search.h), and the scene comparison uses its findings
///         (scene_comparison.h), twice in turn. Not judged: fewer than ten blocks of time, or fewer
///         than 5 % comparable points.
PerceptionDiagnosis DiagnoseScans(const RangeSource& source, std::uint64_t seed);

}  // namespace tera
