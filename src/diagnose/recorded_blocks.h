#pragma once

#include <string>
#include <vector>

#include "diagnose/discrepancy/discrepancy_correction.h"
#include "diagnose/measurements.h"
#include "diagnose/missing_input.h"
#include "diagnose/search/fit/replay_block.h"
#include "resimulate/motion/simulated_course.h"

namespace tera {

struct BlockOptions {
  bool needs_any = true;         ///< it is an error if nothing can be replayed
  double step_s = 0.01;          ///< of the replay of axes, where encoders sample often enough
  double base_interval_s = 0.2;  ///< over which the motion of base and inertial units is compared
  int threads = 2;               ///< the blocks do not depend on it
};

/// All blocks for which the recording has channels: joints and gears with encoders and levers,
/// drives with efforts and encoders, the base with gears and poses, recorded or estimated, inertial
/// units and receivers whose link's motion was measured, over 20 s at least. Throws InputError
/// where there is none at all, unless `needs_any` is false. `not_compared` receives what was
/// measured and makes no block, with the reason.
std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Measurements& measured,
                                  const BlockOptions& options,
                                  std::vector<std::string>* not_compared = nullptr);

/// The joints and gears of which the recording lacks input, beside the simulation of the scenario
/// under the recorded levers where there is one.
std::vector<MissingInput> MissingInputOf(const DiagnosisInput& input, const Measurements& measured,
                                         const BlockOptions& options,
                                         const std::optional<SimulatedCourse>& course = {});

/// Removes and returns the blocks of inertial units and receivers, which come after the machine's
/// own.
std::vector<ReplayBlock> TakeSensorBlocks(const std::string& machine,
                                          std::vector<ReplayBlock>* blocks);

/// The blocks of inertial units and receivers over poses that are stamped as they arrive, at the
/// times at which they were measured. `not_compared` is replaced by the sensors that make no block.
std::vector<ReplayBlock> SensorBlocksByArrivals(const DiagnosisInput& input, Measurements measured,
                                                const BlockOptions& options,
                                                std::vector<std::string>* not_compared);

/// The discrepancies of the replays of joints, gears and base from a simulation of the scenario
/// under the recorded levers, for the blocks of BlocksOf.
std::vector<ReplayDiscrepancy> ReplayDiscrepanciesOf(const DiagnosisInput& input,
                                                     const Measurements& measured,
                                                     const BlockOptions& options,
                                                     const SimulatedCourse& course);

}  // namespace tera
