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

/// Makes all blocks for which the recording has channels of at least 20 s. Joints and running gears
/// need encoders and levers; drives need efforts and encoders. The base needs encoders of its
/// running gear and poses, recorded or estimated. Inertial units and receivers need the measured
/// motion of their link.
///
/// `not_compared` receives the measurements without a block, with the reason. Throws InputError if
/// there is no block and `needs_any` is true.
std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Measurements& measured,
                                  const BlockOptions& options,
                                  std::vector<std::string>* not_compared = nullptr);

/// Joints and running gears whose lever the recording lacks. If `course` is given, it is a
/// simulation under the recorded levers, and motion that it contains too does not count.
std::vector<MissingInput> MissingInputOf(const DiagnosisInput& input, const Measurements& measured,
                                         const std::optional<SimulatedCourse>& course = {});

/// Removes and returns the blocks of inertial units and receivers, which follow the base's block.
std::vector<ReplayBlock> TakeSensorBlocks(const std::string& machine,
                                          std::vector<ReplayBlock>* blocks);

/// Blocks of inertial units and receivers if poses have arrival stamps. The poses are set to their
/// times of measurement. `not_compared` is replaced by the list of sensors without a block.
std::vector<ReplayBlock> SensorBlocksByArrivals(const DiagnosisInput& input, Measurements measured,
                                                const BlockOptions& options,
                                                std::vector<std::string>* not_compared);

/// Discrepancies of the replays of joints, running gears and base, for the blocks of BlocksOf.
/// `course` is a simulation of the scenario under the recorded levers.
std::vector<ReplayDiscrepancy> ReplayDiscrepanciesOf(const DiagnosisInput& input,
                                                     const Measurements& measured,
                                                     const BlockOptions& options,
                                                     const SimulatedCourse& course);

}  // namespace tera
