#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// "In short: boom: dead band 0.18 ± 0.02 (or valve curve); arm: backlash 0.7 ± 0.1 deg.
/// Unexplained: slew rate." The summary has names and parameters alone (for lidars and cameras
/// names), by target, in the order of the sentences that follow. Empty without findings and
/// unexplained errors.
std::string SummaryOf(const Diagnosis& diagnosis);

}  // namespace tera
