#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/confirm/whole_simulation.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/measurements.h"
#include "resimulate/motion/simulate_under_levers.h"

namespace tera {

/// What was learned of a joint, track or wheel set, by its name.
struct LearnedOfAxis {
  std::string axis;
  LearnedEffect effect;
};

/// What a simulation can have of what was found in a machine.
struct SimulatedFindings {
  Structure terms;
  std::vector<LearnedOfAxis> learned = {};

  bool empty() const { return terms.empty() && learned.empty(); }
};

/// What `effects.yaml` says of some blocks: what was named and learned, not what is within
/// tolerance or unconfirmed; poses have no part in a simulation.
SimulatedFindings FindingsToSimulate(const std::vector<DiagnosedBlock>& blocks);

/// Simulates the scenario under recorded levers with what was found in its machine; with nothing:
/// the scenario as it is.
using SimulateMachine = std::function<SimulatedCourse(
    const SimulatedFindings& found, const TableRecording& levers, const CourseSpan& span)>;

/// Simulates the scenario as it is as long as the recording lasts and ten minutes at most. None
/// where `simulate` is empty, or the recording has no levers or nothing of a joint, a track or the
/// base. Times count from the recording's own zero, or from its first sample where that is later
/// than a second.
std::optional<SimulatedCourse> SimulateAsItIs(const DiagnosisInput& input,
                                              const Measurements& measured,
                                              const SimulateMachine& simulate);

/// Simulates the scenario with what was found and learned of joints, tracks and the base, and holds
/// both against the recording on the manoeuvres that the diagnosis kept back.
///
/// Model   no sensors: rates and poses are those of the simulation at the times of the
///         measurements, base motion over the same intervals as the block's. 120 s at most, from 5
///         s before the first lever moves. Path: along poses half a second apart.
/// Omits   inertial units, whose findings nothing here shows.
///
/// `measured` is what the blocks were made of; `before`, if there is one, is the scenario as it is.
/// What of a block no simulation covers is named in `not_simulated`.
WholeSimulation SimulateWhole(const DiagnosisInput& input, const Measurements& measured,
                              double base_interval_s, const std::vector<DiagnosedBlock>& blocks,
                              const std::optional<SimulatedCourse>& before,
                              const SimulateMachine& simulate);

}  // namespace tera
