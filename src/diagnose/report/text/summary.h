#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// "In short: boom: dead band 0.18 ± 0.02 (or valve curve); arm: backlash 0.7 ± 0.1 deg.
/// Unexplained: slew rate." The summary has names and numbers alone (for lidars and cameras names),
/// by their targets, in the order of the sentences that follow. Empty where nothing was found and
/// nothing is unexplained.
std::string SummaryOf(const Diagnosis& diagnosis);

}  // namespace tera
