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

/// Learned effect of the joint, track or wheel set with the name `axis`.
struct LearnedOfAxis {
  std::string axis;
  LearnedEffect effect;
};

/// Findings of a machine that a simulation can run.
struct SimulatedFindings {
  Structure terms;
  std::vector<LearnedOfAxis> learned = {};

  bool empty() const { return terms.empty() && learned.empty(); }
};

/// Contents of `effects.yaml` for some blocks: named and learned effects. Findings within tolerance
/// and unconfirmed ones are left out. So are effects of recorded poses, which a simulation does not
/// have.
SimulatedFindings FindingsToSimulate(const std::vector<DiagnosedBlock>& blocks);

/// Simulates the scenario under recorded levers, with the findings of its machine. Without findings
/// it is the unchanged scenario.
using SimulateMachine = std::function<SimulatedCourse(
    const SimulatedFindings& found, const TableRecording& levers, const CourseSpan& span)>;

/// Simulates the unchanged scenario for the recording's length, at most ten minutes. Empty if
/// `simulate` is empty, if the recording has no levers, or if it has no joint, track or base. Time
/// 0 of the simulation is time 0 of the recording, or the recording's first sample if this is later
/// than 1 s.
std::optional<SimulatedCourse> SimulateAsItIs(const DiagnosisInput& input,
                                              const Measurements& measured,
                                              const SimulateMachine& simulate);

/// Simulates the scenario with the findings and learned effects of joints, tracks and the base.
/// Compares this simulation and that of the unchanged scenario with the recording, on the
/// manoeuvres of FINAL.
///
/// Model   no sensors: rates and poses are those of the simulation at the times of the
///         measurements. Base motion is over the intervals of the base's block. The comparison
///         lasts at most 120 s, from 5 s before the first lever moves. Paths join poses at
///         intervals of 0.5 s.
/// Omits   inertial units, whose findings have no effect here.
WholeSimulation SimulateWhole(const DiagnosisInput& input, const Measurements& measured,
                              const std::vector<DiagnosedBlock>& blocks,
                              const std::optional<SimulatedCourse>& before,
                              const SimulateMachine& simulate);

}  // namespace tera
