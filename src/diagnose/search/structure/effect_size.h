#pragma once

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// RMS difference between two misfits' residuals over the RMS of the measurement; the largest over
/// channels.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
