#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dataset/format/recording.h"
#include "diagnose/confirm/held_out_recording.h"
#include "diagnose/confirm/simulate_whole.h"
#include "diagnose/diagnosed_block.h"
#include "diagnose/recorded_blocks.h"

namespace tera {

/// A held-out recording, which nothing is fitted to, of the machine that is diagnosed.
struct HeldOutCase {
  DiagnosisInput input;
  std::shared_ptr<const Recording> recording;
};

/// A held-out recording's measurements and blocks.
struct HeldOutBlocks {
  HeldOutCase given;
  Measurements measured;
  std::vector<ReplayBlock> blocks;
};

/// Reads a held-out recording. Its blocks are corrected for what replays lack of the simulation,
/// unless `simulate` is empty. Throws InputError where it cannot be compared.
HeldOutBlocks ReadHeldOut(const HeldOutCase& given, const SimulateMachine& simulate, int threads,
                          std::uint64_t seed);

/// Validates a diagnosis on a held-out recording, whose sensors are compared as those of the first
/// were.
HeldOutRecording ValidateHeldOut(const std::vector<DiagnosedBlock>& diagnosed,
                                 const BlockOptions& options, std::uint64_t seed,
                                 HeldOutBlocks* held_out);

}  // namespace tera
