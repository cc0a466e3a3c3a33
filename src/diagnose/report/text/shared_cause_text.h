#pragma once

#include <string>
#include <vector>

#include "diagnose/recordings/shared_causes.h"

// Joint result of several recordings of one machine, in words.

namespace tera {

/// "Boom: dead band", with the mechanisms that fit all recordings equally: "Boom: dead band or
/// valve curve".
std::string HeadingOf(const SharedCause& cause);

/// "0.121 ± 0.005" for each parameter that a recording determines, or the reason why there is none:
/// "not there", "within tolerance: 0.01 ± 0.004".
std::string CellOf(const SharedCause& cause, const CauseInRecording& one);

/// "Boom: dead band in recordings 1 and 3, width 0.121 ± 0.003. Recording 2: not there, where one
/// of this size would have shown."
std::string SentenceOf(const SharedCause& cause);

/// "3 recordings: 2 causes that they share and 1 cause that differs from one to another."
std::string AnswerText(const std::vector<SharedCause>& causes, std::size_t recordings);

}  // namespace tera
