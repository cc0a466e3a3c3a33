#pragma once

#include <string>

#include "core/types/measurement.h"
#include "dataset/export/record_stream.h"

/// Typed views of records. A record must be the stream's last one. Throws InputError if its columns
/// or numbers do not fit the type.

namespace tera {

RowSample RowOf(const Record& record);
ImuSample ImuOf(const RecordStream& stream, const Record& record);
GnssSample GnssOf(const RecordStream& stream, const Record& record);
/// Velocities are 0 if HasVelocity is false.
TruthPose PoseOf(const RecordStream& stream, const Record& record);
bool HasVelocity(const RecordStream& stream, std::size_t channel);

/// The body of a pose file: "excavator1" for truth/excavator1/pose.csv, "excavator1/links/boom" for
/// truth/excavator1/links/boom.csv.
std::string NameOfBody(const std::string& pose_file);

/// Unit quaternion with w >= 0.
Quat UnitQuaternion(const Pose& pose);

}  // namespace tera
