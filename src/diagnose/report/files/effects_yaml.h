#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// Overlay with which `tera generate --effects` simulates the findings: {effects: {MACHINE:
/// {TARGET: {MECHANISM: {PARAMETER: VALUE}}}}}. Numbers have six digits. The first line names
/// `recording`.
///
/// Effects without a mechanism follow as `learned`, with their tables. A comment lists those that
/// no simulation can run.
///
/// Model   Parameters that were not fitted and have their default are left out. If several findings
///         have the same mechanism and target, the one with the highest rank is written. Without
///         findings, the mapping is empty.
std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording);

/// The same for selected findings of one machine of the scenario. The first finding of each
/// mechanism and target is written. `heading` is a comment.
std::string EffectsYaml(const std::string& scenario, const std::vector<const Finding*>& findings,
                        const std::string& heading);

}  // namespace tera
