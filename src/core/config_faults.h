#pragma once

#include <cstddef>

#include "core/config.h"

namespace tera {

/// How many faults the whole configuration of `config` has so far, for checks of what was read
/// without any: what is made of a faulty part is no fault of its own.
std::size_t FaultCount(const ConfigMap& config);

}  // namespace tera
