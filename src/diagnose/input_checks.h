#pragma once

#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/recording.h"
#include "diagnose/replay/axis_log.h"
#include "diagnose/search/fit/replay_block.h"
#include "physics/description/machine.h"

/// What a recording must not be before anything is compared with it. Each check throws InputError
/// that says where, what was found, what is needed, and which unit it may be in; nothing is ever
/// converted.

namespace tera {

/// Where the files of a recording are, for messages.
struct RecordedPlace {
  std::string directory, machine;
};

/// Levers between -1 and 1.
void CheckLevers(const RecordedPlace& place, const TableRecording& commands,
                 const MachineModel& model);

/// Commands, encoders, sensors and poses that have time in common.
void CheckClocks(const RecordedPlace& place, const TableRecording& commands,
                 const std::vector<NamedEncoders>& encoders,
                 const std::vector<std::vector<ImuSample>>& imus,
                 const std::vector<std::vector<GnssSample>>& gnss,
                 const std::vector<TruthPose>& poses);

/// No column that stands still while its own lever, or the other column of the joint, moves; rates
/// that are the changes of positions, and positions within the joints' limits, but for factors that
/// are not those of units.
void CheckEncoders(const RecordedPlace& place, const TableRecording& commands,
                   const std::vector<NamedEncoders>& encoders, const MachineModel& model);

/// No axis of a triad that stands still while another one changes; specific forces about that of
/// gravity. `channel` is the unit's folder.
void CheckImu(const RecordedPlace& place, const std::string& channel,
              const std::vector<ImuSample>& samples);

/// No position that stands still while the machine drives, and none that is a multiple of the
/// machine's by a factor of units. `channel` is the receiver's folder.
void CheckGnss(const RecordedPlace& place, const std::string& channel,
               const std::vector<GnssSample>& samples, const std::vector<TruthPose>& poses);

/// Channels that are no multiple of what their replay predicts by a factor of units.
void CheckUnitsOf(const RecordedPlace& place, const std::vector<ReplayBlock>& blocks);

}  // namespace tera
