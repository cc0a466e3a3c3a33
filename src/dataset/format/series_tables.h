#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"

namespace tera {

/// The tables that a recording has beside its sensors, but for levers and truth: set-points,
/// efforts and whatever else an import kept. Their columns are numbers over time.
std::vector<std::string> SeriesTables(const Recording& recording);

}  // namespace tera
