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
  bool needs_any = true;  ///< whether it is an error if nothing can be replayed
  int threads = 2;        ///< without influence on the blocks
};

/// All blocks for which the recording has channels of 20 s or more: joints and gears with encoders
/// and levers; drives with efforts and encoders; the base with gears and poses, recorded or
/// estimated; inertial units and receivers whose link's motion was measured. Throws InputError if
/// there are none, unless `needs_any` is false. `not_compared` receives measurements without a
/// block, with the reason.
std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Measurements& measured,
                                  const BlockOptions& options,
                                  std::vector<std::string>* not_compared = nullptr);

/// Joints and gears whose input the recording lacks, compared with the simulation under the
/// recorded levers if there is one.
std::vector<MissingInput> MissingInputOf(const DiagnosisInput& input, const Measurements& measured,
                                         const std::optional<SimulatedCourse>& course = {});

/// Removes and returns the blocks of inertial units and receivers, which follow the machine's own.
std::vector<ReplayBlock> TakeSensorBlocks(const std::string& machine,
                                          std::vector<ReplayBlock>* blocks);

/// The blocks of inertial units and receivers over poses with arrival stamps, at their times of
/// measurement. `not_compared` becomes the list of sensors without a block.
std::vector<ReplayBlock> SensorBlocksByArrivals(const DiagnosisInput& input, Measurements measured,
                                                const BlockOptions& options,
                                                std::vector<std::string>* not_compared);

/// Discrepancies of the replays of joints, gears and base from a simulation of the scenario under
/// the recorded levers, for the blocks of BlocksOf.
std::vector<ReplayDiscrepancy> ReplayDiscrepanciesOf(const DiagnosisInput& input,
                                                     const Measurements& measured,
                                                     const BlockOptions& options,
                                                     const SimulatedCourse& course);

}  // namespace tera
