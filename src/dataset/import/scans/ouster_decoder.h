#pragma once

#include "dataset/import/scans/ouster_sheet.h"
#include "dataset/import/scans/packet_decoder.h"

namespace tera {

/// Packets of an Ouster.
///
/// Frames  lidar's L, x towards the connector; S as its metadata have it in L.
/// Model   column m of M of a turn at theta = 2 pi (1 - m / M); beam i at altitude phi_i and
///         theta_i = theta - azimuth_i; with n the distance of the beams' origin (b_x, 0, b_z) from
///         that of L, range r: x = (r - n) cos theta_i cos phi_i + b_x cos theta, y likewise with
///         sines, z = (r - n) sin phi_i + b_z. A scan is a frame by its number; a column's time is
///         its own stamp. Columns that are not marked as valid are no rays. A return that stands
///         second without a first is its ray's only one. Rings count from the top.
/// Omits   signal and near-infrared; packets that come after those of the next frame, which are
///         faults.
/// Source  Ouster Firmware User Manual, "Lidar data" and "Lidar range to XYZ".
std::unique_ptr<PacketDecoder> MakeOusterDecoder(const OusterSheet& sheet,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
