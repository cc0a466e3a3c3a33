#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnosis.h"

namespace tera {

/// The sentence of a diagnosis without findings: the channels that agree, and the undetectable
/// mechanisms.
std::string SentenceOfNothing(const Diagnosis& diagnosis);

/// All sentences of a diagnosis, by descending weight.
std::vector<std::string> SentencesOf(const Diagnosis& diagnosis);

}  // namespace tera
