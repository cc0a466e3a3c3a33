#pragma once

#include <vector>

#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// Whether enough manoeuvres were commanded for findings to be chosen and confirmed: six of TRAIN
/// and SELECT, three of FINAL.
bool IsTestable(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
