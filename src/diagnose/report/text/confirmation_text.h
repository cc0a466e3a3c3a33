#pragma once

#include <string>
#include <vector>

#include "diagnose/confirm/held_out_recording.h"
#include "diagnose/confirm/whole_simulation.h"
#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/experiment_design/next_manoeuvre.h"

namespace tera {

/// "On out/second, of which nothing was known: boom rate 3.1 → 0.6 deg/s, arm rate 2 → 0.2 deg/s."
std::string SentenceOf(const HeldOutRecording& further);

/// "The whole simulation, 0–90 s, on manoeuvres kept back: boom rate 1.8 → 0.02 deg/s; path 57.4 m
/// recorded, 50.5 → 57.1 m simulated. It does not follow in: slew rate."
std::string SentenceOf(const WholeSimulation& whole);

/// "Corrected for what the replays lack of the simulation: yaw rate 2.1 deg/s (RMS)." Only
/// significant corrections appear. Empty without any.
std::string SentenceOf(const std::vector<DiscrepancyCorrection>& corrections);

/// Name of the file of levers in the report's folder.
inline constexpr const char* kNextManoeuvreFile = "next_manoeuvre.csv";

/// "Next manoeuvre (next_manoeuvre.csv, 39 s; boom: steps of 0.15 and steps of 1): tells dead band
/// and rate gain of the boom apart; would show backlash of the boom. Power 0.93 at least."
std::string SentenceOf(const NextManoeuvre& next);

/// The levers in the form of commands.csv: t_ns and one column per lever, -1 to 1. There is a row
/// at each lever move.
std::string CsvOf(const NextManoeuvre& next);

}  // namespace tera
