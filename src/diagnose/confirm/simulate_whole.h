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

/// Learned effect of a joint, track or wheel set, by its name.
struct LearnedOfAxis {
  std::string axis;
  LearnedEffect effect;
};

/// The part of a machine's findings that a simulation can run.
struct SimulatedFindings {
  Structure terms;
  std::vector<LearnedOfAxis> learned = {};

  bool empty() const { return terms.empty() && learned.empty(); }
};

/// Contents of `effects.yaml` for some blocks: named and learned effects, without findings that are
/// within tolerance or unconfirmed. Effects of poses are no part of a simulation.
SimulatedFindings FindingsToSimulate(const std::vector<DiagnosedBlock>& blocks);

/// Simulates the scenario under recorded levers with the findings of its machine; without any, the
/// unchanged scenario.
using SimulateMachine = std::function<SimulatedCourse(
    const SimulatedFindings& found, const TableRecording& levers, const CourseSpan& span)>;

/// Simulates the unchanged scenario for the recording's length, at most ten minutes. None if
/// `simulate` is empty, if the recording has no levers, or if it has no joint, track or base. Times
/// count from the recording's zero, or from its first sample if that is later than a second.
std::optional<SimulatedCourse> SimulateAsItIs(const DiagnosisInput& input,
                                              const Measurements& measured,
                                              const SimulateMachine& simulate);

/// Simulates the scenario with the findings and learned effects of joints, tracks and the base.
/// Compares it and the unchanged scenario with the recording, on the manoeuvres that the diagnosis
/// kept back.
///
/// Model   no sensors: rates and poses are the simulation's at the times of the measurements, base
///         motion over the same intervals as the block's. At most 120 s, from 5 s before the first
///         lever moves. Path: along poses half a second apart.
/// Omits   inertial units, whose findings do not show here.
///
/// `measured` is the blocks' source; `before`, if present, is the unchanged scenario. Parts of a
/// block that the simulation does not cover are listed in `not_simulated`.
WholeSimulation SimulateWhole(const DiagnosisInput& input, const Measurements& measured,
                              double base_interval_s, const std::vector<DiagnosedBlock>& blocks,
                              const std::optional<SimulatedCourse>& before,
                              const SimulateMachine& simulate);

}  // namespace tera
