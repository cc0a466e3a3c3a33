#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "All 4 joints ask for a delay of 0.08 s: ..", or empty. The sentence needs two joints or more
/// judged by their encoders, all with the same delay, within a fifth or within its uncertainty. The
/// encoders' clock may then be late instead.
std::string SentenceOfSharedDelay(const Diagnosis& diagnosis);

/// "Encoders run ahead of the levers that move them, by about 0.1 s: ..", or empty.
std::string SentenceOfEncoderLead(const Diagnosis& diagnosis);

/// "In short: boom: dead band 0.18 ± 0.02 (or valve curve); arm: backlash 0.7 ± 0.1 deg.
/// Unexplained: slew rate." The summary has names and parameters alone (for lidars and cameras
/// names), by target, in the order of the sentences that follow. Empty without findings and
/// unexplained errors.
std::string SummaryOf(const Diagnosis& diagnosis);

/// The sentence of a diagnosis without findings: the channels that agree, and the undetectable
/// mechanisms.
std::string SentenceOfNothing(const Diagnosis& diagnosis);

/// The sentence of a cause: where, which, how sure, and how much better.
std::string SentenceOf(const Cause& cause);

/// All sentences of a diagnosis, by descending weight.
std::vector<std::string> SentencesOf(const Diagnosis& diagnosis);

}  // namespace tera
