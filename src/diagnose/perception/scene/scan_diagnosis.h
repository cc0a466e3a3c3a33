#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/types/effects.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Mechanisms of the scene, with their measures: `terrain_height`, `object_added`, `object_missing`
/// and `dust`. A scenario cannot contain them as effects, so they have no target in effects.yaml.
std::span<const Mechanism> SceneMechanisms();

/// The scene mechanism with this identifier, which must exist.
const Mechanism& SceneMechanism(std::string_view id);

/// Diagnoses the differences between a lidar's scans, or a depth camera's images, and their
/// simulation. Causes are effects on the sensor and differences of the scene.
///
/// Model   The scene is compared first. If scene differences explain less than half of the points,
///         and the other points show no sensor error, only the scene is reported. A scene that
///         differs in a few places is thus preferred to a sensor that differs everywhere. Otherwise
///         the sensor is searched first (registration_search.h). Scene and sensor then alternate
///         for two rounds.
///         A sensor is not judged with fewer than ten blocks of time, or if fewer than 5 % of its
///         points are comparable.
PerceptionDiagnosis DiagnoseScans(const RangeSource& source, std::uint64_t seed);

}  // namespace tera
