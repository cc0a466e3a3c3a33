#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

// Checks of a recording before anything is compared with it. Each check throws InputError that says
// where, what was found, what is needed, and which unit it may be in; nothing is ever converted.

namespace tera {

/// The place of a recording's files, for messages.
struct RecordedPlace {
  std::string directory, machine;
};

/// Checks that levers are between -1 and 1.
void CheckLevers(const RecordedPlace& place, const TableRecording& commands,
                 const MachineModel& model);

/// Checks that commands, encoders, sensors and poses have time in common.
void CheckClocks(const RecordedPlace& place, const TableRecording& commands,
                 const std::vector<NamedEncoders>& encoders,
                 const std::vector<std::vector<ImuSample>>& imus,
                 const std::vector<std::vector<GnssSample>>& gnss,
                 const std::vector<TruthPose>& poses);

/// Checks that no column is constant while its lever, or the joint's other column, moves, and that
/// rates over changes of positions, and positions over the joints' limits, are no factors of units.
void CheckEncoders(const RecordedPlace& place, const TableRecording& commands,
                   const std::vector<NamedEncoders>& encoders, const MachineModel& model);

/// Checks that no axis of a triad is constant while another one changes, and that specific forces
/// are about that of gravity. `channel` is the unit's folder.
void CheckImu(const RecordedPlace& place, const std::string& channel,
              const std::vector<ImuSample>& samples);

/// Checks that no position is constant while the machine drives, and that none is a multiple of the
/// machine's by a factor of units. `channel` is the receiver's folder.
void CheckGnss(const RecordedPlace& place, const std::string& channel,
               const std::vector<GnssSample>& samples, const std::vector<TruthPose>& poses);

/// Checks that no channel is a multiple of its replay's prediction by a factor of units.
void CheckUnitsOf(const RecordedPlace& place, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
