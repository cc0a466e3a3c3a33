#pragma once

#include <string>

#include "diagnose/experiment_design/next_manoeuvre.h"

namespace tera {

/// The file of levers beside diagnosis.json.
inline constexpr const char* kNextManoeuvreFile = "next_manoeuvre.csv";

/// "Next manoeuvre (next_manoeuvre.csv, 39 s; boom: steps of 0.15 and steps of 1): tells dead band
/// and rate gain of the boom apart; would show backlash of the boom. Power 0.93 at least."
std::string SentenceOf(const NextManoeuvre& next);

/// The levers in the form of commands.csv: t_ns and a column for each lever, -1 to 1, with a row
/// wherever one moves.
std::string CsvOf(const NextManoeuvre& next);

}  // namespace tera
