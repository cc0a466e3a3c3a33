#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/random.h"
#include "dataset/recording.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/search/block_diagnosis.h"
#include "physics/machine.h"
#include "sensors/sensor.h"

namespace tera {

/// A block and what came of it. The findings point into the block's suspects: it is moved, not
/// copied.
struct DiagnosedBlock {
  DiagnosedBlock() = default;
  DiagnosedBlock(DiagnosedBlock&&) = default;
  DiagnosedBlock& operator=(DiagnosedBlock&&) = default;

  ReplayBlock block;
  BlockDiagnosis diagnosis;
};

/// Why one machine's recording differs from its simulation.
struct Diagnosis {
  std::string machine;   ///< its name in the recording
  std::string scenario;  ///< its name in the scenario, to which the overlay speaks
  std::vector<DiagnosedBlock> blocks;
  std::vector<PerceptionDiagnosis> perception;  ///< of sensors that measure ranges
};

/// What a diagnosis can say; several may hold.
enum class Verdict { kNone, kNamed, kClass, kUnexplained, kUntestable };

/// As in diagnosis.json: "named".
std::string_view NameOf(Verdict verdict);

/// kNone where nothing was found and nothing is left of the blocks that could be judged; kNamed,
/// kClass by the findings; kUnexplained where error is left; kUntestable where a block could not be
/// judged, or some suspect would not have been seen at any size.
std::vector<Verdict> VerdictsOf(const Diagnosis& diagnosis);

/// What is to be diagnosed.
struct DiagnosisInput {
  const MachineModel* model = nullptr;
  std::string machine;      ///< name in the recording
  std::string scenario;     ///< name in the scenario
  TableRecording commands;  ///< columns by the names of levers
  /// As the scenario has them, by the names that they have in the recording.
  std::vector<SensorDescription> sensors;
};

struct DiagnosisOptions {
  SearchOptions search;
  std::uint64_t seed = 1;
  double step_s = 0.01;           ///< of the replay of axes
  double from_s = 0, to_s = 1e9;  ///< part of the recording to look at, from its first sample on
  bool needs_blocks = true;       ///< that nothing can be replayed is an error
  double base_interval_s = 0.2;   ///< over which the motion of base and inertial units is compared
};

/// Every block that the recording has channels for: joints and gears with encoders and levers, the
/// base with gears and poses, inertial units whose link's motion was measured, over 25 s at least.
/// Throws InputError where there is none at all, unless `needs_blocks` is false.
std::vector<ReplayBlock> BlocksOf(const DiagnosisInput& input, const Recording& recording,
                                  const DiagnosisOptions& options);

/// From which all that is random about a block's diagnosis comes.
Stream StreamOf(const ReplayBlock& block, std::uint64_t seed);

/// Diagnoses blocks, whose tests count together. `progress` is told what is looked at, before each.
std::vector<DiagnosedBlock> DiagnoseBlocks(std::vector<ReplayBlock> blocks, SearchOptions options,
                                           std::uint64_t seed,
                                           const std::function<void(const std::string&)>& progress);

/// Both.
Diagnosis Diagnose(const DiagnosisInput& input, const Recording& recording,
                   const DiagnosisOptions& options,
                   const std::function<void(const std::string&)>& progress);

}  // namespace tera
