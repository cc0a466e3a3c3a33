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

/// A held-out recording of the diagnosed machine.
struct HeldOutCase {
  DiagnosisInput input;
  std::shared_ptr<const Recording> recording;
};

/// The measurements and blocks of a held-out recording, and its simulation if requested.
struct HeldOutBlocks {
  HeldOutCase given;
  Measurements measured;
  std::optional<SimulatedCourse> as_it_is;
  std::vector<ReplayBlock> blocks;
};

/// Reads a held-out recording. Unless `simulate` is empty, its blocks are corrected for the
/// replay's discrepancy. Throws InputError if the recording cannot be compared.
HeldOutBlocks ReadHeldOut(const HeldOutCase& given, const SimulateMachine& simulate, int threads,
                          std::uint64_t seed);

/// Corrects stamps of poses and encoders of a held-out recording (StampPosesAnew,
/// StampEncodersAnew), for clocks that the estimate of the first recording names. Rebuilds its
/// blocks.
void StampAnew(const SensorDiagnosis& estimate, int threads, std::uint64_t seed,
               HeldOutBlocks* held_out);

/// Validates a diagnosis on a held-out recording. Sensors are compared as in the first recording.
HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const BlockOptions& options, std::uint64_t seed,
                                 HeldOutBlocks* held_out);

}  // namespace tera
