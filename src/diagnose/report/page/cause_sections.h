#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// The first screen of report.html: the causes, in sentences for a machine's user.

namespace tera {

/// "2 causes found.", or a sentence that there is none, or that nothing was judged.
std::string AnswerText(const Diagnosis& diagnosis);

/// Prerequisites to mend first: missing input, clocks that differ.
std::string FirstThings(const Diagnosis& diagnosis);

/// A section for each cause, by descending size, and for each unexplained error. Without either:
/// the channels that agree, and the undetectable mechanisms.
std::string CauseSections(const Diagnosis& diagnosis);

}  // namespace tera
