#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// The sentence where nothing was found: which channels agree, and what could not have been seen.
std::string SentenceOfNothing(const Diagnosis& diagnosis);

/// All sentences of a diagnosis, the weightiest first.
std::vector<std::string> SentencesOf(const Diagnosis& diagnosis);

}  // namespace tera
