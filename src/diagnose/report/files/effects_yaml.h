#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// The overlay with which `tera generate --effects` simulates what was found: {effects: {MACHINE:
/// {TARGET: {MECHANISM: {PARAMETER: VALUE}}}}}, six digits, a first line that names `recording`.
///
/// What has no name stands below it as `learned`, with its table; what of it no simulation can have
/// is told in a comment.
///
/// Model   parameters that were not fitted and have their default are omitted. Of two findings of
///         one mechanism on one target the one that ranks first stands. Without findings the
///         mapping is empty.
std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording);

/// The same of some findings of a machine of the scenario alone, the first of one mechanism on one
/// target; `heading` is a comment.
std::string EffectsYaml(const std::string& scenario, const std::vector<const Finding*>& findings,
                        const std::string& heading);

}  // namespace tera
