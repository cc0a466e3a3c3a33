#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The overlay with which `tera generate --effects` simulates what was found: {effects: {MACHINE:
/// {TARGET: {MECHANISM: {PARAMETER: VALUE}}}}}, six digits, a first line that names `recording`.
///
/// Model   parameters that were not fitted and have their default are left out. Of two findings of
///         one mechanism on one target the weightier stands. An empty mapping where there are none.
std::string EffectsYaml(const Diagnosis& diagnosis, const std::string& recording);

}  // namespace tera
