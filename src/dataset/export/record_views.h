#pragma once

#include <string>

#include "core/types/measurement.h"
#include "dataset/export/record_stream.h"

/// Records as what they are. A record must be the one that its stream gave last; throws InputError
/// where its columns or numbers are not those of its type.

namespace tera {

RowSample RowOf(const Record& record);
ImuSample ImuOf(const RecordStream& stream, const Record& record);
GnssSample GnssOf(const RecordStream& stream, const Record& record);
/// Velocities are 0 where HasVelocity says that there are none.
TruthPose PoseOf(const RecordStream& stream, const Record& record);
bool HasVelocity(const RecordStream& stream, std::size_t channel);

/// What a pose is of: "excavator1" for truth/excavator1/pose.csv, "excavator1/links/boom" for
/// truth/excavator1/links/boom.csv.
std::string NameOfBody(const std::string& pose_file);

/// Unit quaternion with w >= 0.
Quat UnitQuaternion(const Pose& pose);

}  // namespace tera
