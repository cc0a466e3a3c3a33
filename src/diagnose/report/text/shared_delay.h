#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// "All 4 joints ask for a delay of 0.08 s: ..", or nothing. Where every joint that was judged by
/// its encoder, two at least, is found to have the same delay, to a fifth or to what its numbers
/// are uncertain by, clocks do as well.
std::string SentenceOfSharedDelay(const Diagnosis& diagnosis);

}  // namespace tera
