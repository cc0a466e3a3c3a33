#pragma once

#include <string>

#include "diagnose/report/text/cause.h"

// Answers to a reader's questions on a named cause.

namespace tera {

/// "Fairly sure. Chance alone would do as well in 1 of 5000 cases on the driving that the cause was
/// chosen by, and in 1 of 250 on driving kept back."
std::string HowSureText(const Cause& cause);

/// "This recording cannot tell it from: valve curve (a valve that does not open in proportion to
/// the lever)." Without an equal rival, the sentence says so and names the nearest one.
std::string WhatElseText(const Cause& cause);

/// "The levers in next_manoeuvre.csv (34 s; boom: steps of 0.15) tell dead band and valve curve
/// apart in 90 of 100 recordings."
std::string WhatToDriveText(const Cause& cause, const Diagnosis& diagnosis);

/// "1 of 250", "fewer than 1 of 10 000".
std::string OddsText(double p);

}  // namespace tera
