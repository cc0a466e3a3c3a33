#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

// Checks of a recording before any comparison. Each check throws InputError with the place, the
// found value, the required value and the likely unit. No check converts a value.

namespace tera {

/// Location of a recording's files, for messages.
struct RecordedPlace {
  std::string directory, machine;
};

/// Checks that all levers are between -1 and 1.
void CheckLevers(const RecordedPlace& place, const TableRecording& commands,
                 const MachineModel& model);

/// Checks that commands, encoders, sensors and poses have a common time.
void CheckClocks(const RecordedPlace& place, const TableRecording& commands,
                 const std::vector<NamedEncoders>& encoders,
                 const std::vector<std::vector<ImuSample>>& imus,
                 const std::vector<std::vector<GnssSample>>& gnss,
                 const std::vector<TruthPose>& poses);

/// Checks that no column is constant while its lever, or the joint's other column, moves. Checks
/// for unit factors such as 57.3 in two ratios: rates to changes of positions, and positions to the
/// joints' limits.
void CheckEncoders(const RecordedPlace& place, const TableRecording& commands,
                   const std::vector<NamedEncoders>& encoders, const MachineModel& model);

/// Checks that no axis of a triad is constant while another changes, and that specific forces are
/// near gravity. `channel` is the unit's folder.
void CheckImu(const RecordedPlace& place, const std::string& channel,
              const std::vector<ImuSample>& samples);

/// Checks that no position is constant while the machine drives, and that no position differs from
/// the machine's by a unit factor. `channel` is the receiver's folder.
void CheckGnss(const RecordedPlace& place, const std::string& channel,
               const std::vector<GnssSample>& samples, const std::vector<TruthPose>& poses);

/// Checks that no channel differs from its replay's prediction by a unit factor.
void CheckUnitsOf(const RecordedPlace& place, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
