#pragma once

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// RMS difference of two misfits over the channel's RMS, the largest over channels.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
