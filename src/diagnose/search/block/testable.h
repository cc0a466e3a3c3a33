#pragma once

#include <vector>

#include "diagnose/statistics/series/manoeuvres.h"

namespace tera {

/// True if there are enough commanded manoeuvres to choose and confirm findings: six in TRAIN and
/// SELECT, three in FINAL.
bool IsTestable(const std::vector<Manoeuvre>& manoeuvres);

}  // namespace tera
