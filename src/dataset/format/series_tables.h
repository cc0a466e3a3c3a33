#pragma once

#include <string>
#include <vector>

#include "dataset/format/recording.h"

namespace tera {

/// The tables of a recording other than sensors, levers and truth: set-points, efforts and other
/// imported data. Their columns are numbers over time.
std::vector<std::string> SeriesTables(const Recording& recording);

}  // namespace tera
