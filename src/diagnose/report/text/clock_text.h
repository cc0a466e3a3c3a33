#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// "All 4 joints ask for a delay of 0.08 s: ..", or empty. Where every joint that was judged by its
/// encoder, two at least, has the same delay, within a fifth or within the delays' uncertainty, the
/// clock of the encoders may be late instead.
std::string SentenceOfSharedDelay(const Diagnosis& diagnosis);

/// "Encoders run ahead of the levers that move them, by about 0.1 s: ..", or empty.
std::string SentenceOfEncoderLead(const Diagnosis& diagnosis);

}  // namespace tera
