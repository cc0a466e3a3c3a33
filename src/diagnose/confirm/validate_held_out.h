#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/confirm/held_out_recording.h"
#include "diagnose/confirm/simulate_whole.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/recorded_blocks.h"
#include "diagnose/sensors/sensor_diagnosis.h"

namespace tera {

/// A held-out recording of the diagnosed machine, to which nothing is fitted.
struct HeldOutCase {
  DiagnosisInput input;
  std::shared_ptr<const Recording> recording;
};

/// A held-out recording's measurements, simulated course (if requested), and blocks.
struct HeldOutBlocks {
  HeldOutCase given;
  Measurements measured;
  std::optional<SimulatedCourse> as_it_is;
  std::vector<ReplayBlock> blocks;
};

/// Reads a held-out recording. Its blocks are corrected for the replay's discrepancy, unless
/// `simulate` is empty. Throws InputError where it cannot be compared.
HeldOutBlocks ReadHeldOut(const HeldOutCase& given, const SimulateMachine& simulate, int threads,
                          std::uint64_t seed);

/// Moves stamps of poses and encoders of a held-out recording to their times of measurement, by
/// StampPosesAnew and StampEncodersAnew. Applies only to clocks that the estimate of the first
/// recording names. Then rebuilds its blocks.
void StampAnew(const SensorDiagnosis& estimate, int threads, std::uint64_t seed,
               HeldOutBlocks* held_out);

/// Validates a diagnosis on a held-out recording, with the same sensor comparison as in the first.
HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const BlockOptions& options, std::uint64_t seed,
                                 HeldOutBlocks* held_out);

}  // namespace tera
