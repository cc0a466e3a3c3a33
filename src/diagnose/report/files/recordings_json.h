#pragma once

#include <string>
#include <vector>

#include "diagnose/recordings/shared_causes.h"

namespace tera {

/// The text of recordings.json: the recordings, and each cause with every recording's result and
/// its pooled parameters.
std::string RecordingsJson(const std::vector<std::string>& recordings,
                           const std::vector<SharedCause>& causes);

}  // namespace tera
