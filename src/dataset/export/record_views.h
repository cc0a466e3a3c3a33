#pragma once

#include <string>

#include "core/types/measurement.h"
#include "dataset/export/record_stream.h"

/// Convert a record to a typed sample. The record must be the last one read from its stream. Throw
/// InputError if columns or numbers do not fit the type.

namespace tera {

RowSample RowOf(const Record& record);
ImuSample ImuOf(const RecordStream& stream, const Record& record);
GnssSample GnssOf(const RecordStream& stream, const Record& record);
/// Velocities are 0 if the channel has no velocities.
TruthPose PoseOf(const RecordStream& stream, const Record& record);
bool HasVelocity(const RecordStream& stream, std::size_t channel);

/// Name of the body in a pose file: "excavator1" for truth/excavator1/pose.csv,
/// "excavator1/links/boom" for truth/excavator1/links/boom.csv.
std::string NameOfBody(const std::string& pose_file);

/// Unit quaternion with w >= 0.
Quat UnitQuaternion(const Pose& pose);

}  // namespace tera
