#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/types/effects.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scans/range_source.h"

namespace tera {

/// Mechanisms of the scene, by their measures: `terrain_height`, `object_added`, `object_missing`
/// and `dust`. A scenario has no such effects, so they have no target in effects.yaml.
std::span<const Mechanism> SceneMechanisms();

/// The mechanism with that identifier, which must exist.
const Mechanism& SceneMechanism(std::string_view id);

/// Diagnoses differences between a lidar's scans, or a depth camera's images, and their simulation:
/// effects on the sensor, and differences of the scene.
///
/// Model   a scene that differs in a few places is preferred to a sensor that differs everywhere,
///         if the sensor is right elsewhere. Otherwise the sensor comes first
///         (registration_search.h), and the comparison of the scene uses its findings, twice in
///         turn. Not judged: fewer than ten blocks of time, or fewer than 5 % comparable points.
PerceptionDiagnosis DiagnoseScans(const RangeSource& source, std::uint64_t seed);

}  // namespace tera
