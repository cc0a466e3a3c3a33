#pragma once

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// RMS of the difference of two misfits over the RMS of the channel, the largest over channels.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
