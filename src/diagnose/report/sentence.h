#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "Boom rate, 41–63 s and 8 more intervals; the error depends on |lever| < 0.2, odd: dead band
/// 0.18 ± 0.02 (confidence 0.93; rivals rejected: valve curve). Held-out RMSE 3.1 → 0.6 deg/s, 94 %
/// of the excess variance removed. Nothing left."
///
/// Times are from the block's first sample. The interval is the longest. "± " stands where the data
/// hold the number; numbers that were not fitted are left out.
std::string SentenceOf(const DiagnosedBlock& diagnosed, const Finding& finding);

/// What no mechanism explains: where, and of what it is a function.
std::string SentenceOf(const DiagnosedBlock& diagnosed, const Unexplained& unexplained);

/// Which channels agree, and how much could not have been seen.
std::string SentenceOfNothing(const Diagnosis& diagnosis);

/// All of them, the weightiest first.
std::vector<std::string> SentencesOf(const Diagnosis& diagnosis);

/// "|lever| < 0.2, odd", in readable units.
std::string RegimeText(const Regime& regime, const DiagnosedBlock& diagnosed, std::size_t channel);

}  // namespace tera
