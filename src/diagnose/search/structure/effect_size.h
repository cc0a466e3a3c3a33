#pragma once

#include "diagnose/search/fit/structure_fit.h"

namespace tera {

/// RMS difference between the residuals of two misfits, divided by the RMS of the measurement. The
/// largest value of all channels.
double EffectOf(const ReplayBlock& block, const Misfit& with, const Misfit& without);

}  // namespace tera
