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

/// A held-out recording, which nothing is fitted to, of the machine that is diagnosed.
struct HeldOutCase {
  DiagnosisInput input;
  std::shared_ptr<const Recording> recording;
};

/// A held-out recording's measurements, what the simulation does in it (if it was asked), and
/// blocks.
struct HeldOutBlocks {
  HeldOutCase given;
  Measurements measured;
  std::optional<SimulatedCourse> as_it_is;
  std::vector<ReplayBlock> blocks;
};

/// Reads a held-out recording. Its blocks are corrected for what replays lack of the simulation,
/// unless `simulate` is empty. Throws InputError where it cannot be compared.
HeldOutBlocks ReadHeldOut(const HeldOutCase& given, const SimulateMachine& simulate, int threads,
                          std::uint64_t seed);

/// Stamps poses and encoders of a held-out recording when they measured, where the estimate of the
/// first recording names their clocks, as StampPosesAnew and StampEncodersAnew do; its blocks are
/// then made anew.
void StampAnew(const SensorDiagnosis& estimate, int threads, std::uint64_t seed,
               HeldOutBlocks* held_out);

/// Validates a diagnosis on a held-out recording, whose sensors are compared as those of the first
/// were.
HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const BlockOptions& options, std::uint64_t seed,
                                 HeldOutBlocks* held_out);

}  // namespace tera
