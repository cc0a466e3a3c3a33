#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"

namespace tera {

/// Tables of a recording that hold time series but are neither sensors, levers nor ground truth.
/// Examples are set-points, efforts and other imported data.
std::vector<std::string> SeriesTables(const Recording& recording);

}  // namespace tera
