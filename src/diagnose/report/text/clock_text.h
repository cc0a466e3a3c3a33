#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// "All 4 joints ask for a delay of 0.08 s: ..", or empty. The sentence needs two joints or more
/// judged by their encoders, all with the same delay, within a fifth or within its uncertainty. The
/// encoders' clock may then be late instead.
std::string SentenceOfSharedDelay(const Diagnosis& diagnosis);

/// "Encoders run ahead of the levers that move them, by about 0.1 s: ..", or empty.
std::string SentenceOfEncoderLead(const Diagnosis& diagnosis);

}  // namespace tera
