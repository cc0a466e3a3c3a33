#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// The overlay with which `tera generate --effects` simulates the findings: {effects: {MACHINE:
/// {TARGET: {MECHANISM: {PARAMETER: VALUE}}}}}, six digits. The first line names `recording`.
///
/// Unnamed effects follow as `learned`, with their tables. A comment lists those that no simulation
/// can run.
///
/// Model   parameters that were not fitted and have their default are omitted. Among findings of
///         one mechanism on one target, the highest-ranked counts. Without findings the mapping is
///         empty.
std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording);

/// The same for selected findings of one machine of the scenario, with the first one of each
/// mechanism and target; `heading` is a comment.
std::string EffectsYaml(const std::string& scenario, const std::vector<const Finding*>& findings,
                        const std::string& heading);

}  // namespace tera
