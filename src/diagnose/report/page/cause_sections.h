#pragma once

#include <string>

#include "diagnose/diagnosis.h"

// The first screen of report.html: what is wrong, in sentences for someone who uses the machine.

namespace tera {

/// "2 causes found." or, where there is none, that nothing is wrong, or that nothing was judged.
std::string AnswerText(const Diagnosis& diagnosis);

/// What must be mended before anything else: input that is missing, clocks that differ.
std::string FirstThings(const Diagnosis& diagnosis);

/// A section for each cause, the largest first, and for each error that nothing explains. Where
/// there are neither: what agrees, and what could not have been seen.
std::string CauseSections(const Diagnosis& diagnosis);

}  // namespace tera
