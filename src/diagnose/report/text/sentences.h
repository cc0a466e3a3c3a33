#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// "All 4 joints ask for a delay of 0.08 s: ..", or empty. The sentence needs at least two joints
/// whose encoders were judged. The delays must agree within a fifth or within their uncertainty.
/// The cause may then be a late clock of the encoders.
std::string SentenceOfSharedDelay(const Diagnosis& diagnosis);

/// "Encoders run ahead of the levers that move them, by about 0.1 s: ..", or empty.
std::string SentenceOfEncoderLead(const Diagnosis& diagnosis);

/// "In short: boom: dead band 0.18 ± 0.02 (or valve curve); arm: backlash 0.7 ± 0.1 deg.
/// Unexplained: slew rate." The summary has only names and parameters, by target, in the order of
/// the other sentences. For lidars and cameras it has only names. Empty without findings and
/// unexplained errors.
std::string SummaryOf(const Diagnosis& diagnosis);

/// Sentence of a diagnosis without findings: channels that agree, and undetectable mechanisms.
std::string SentenceOfNothing(const Diagnosis& diagnosis);

/// Sentence of a cause: location, mechanism, certainty and improvement.
std::string SentenceOf(const Cause& cause);

/// All sentences of a diagnosis, by descending importance.
std::vector<std::string> SentencesOf(const Diagnosis& diagnosis);

}  // namespace tera
