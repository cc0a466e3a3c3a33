#pragma once

#include "dataset/import/scans/ouster_sheet.h"
#include "dataset/import/scans/packet_decoder.h"

namespace tera {

/// Decoder for packets of an Ouster.
///
/// Frames  lidar's frame L, x towards the connector; S from the metadata's transform to L.
/// Model   column m of M of a turn at theta = 2 pi (1 - m / M); beam i at altitude phi_i and
///         theta_i = theta - azimuth_i. With range r and n the distance of the beams' origin (b_x,
///         0, b_z) from that of L: x = (r - n) cos theta_i cos phi_i + b_x cos theta, y likewise
///         with sines, z = (r - n) sin phi_i + b_z. A scan is a frame by its number; each column
///         has its own stamp. Columns not marked as valid are no rays. A second return without a
///         first is its ray's only return. Rings count from the top.
/// Omits   signal and near-infrared. Packets that come after those of the next frame are faults.
/// Source  Ouster Firmware User Manual, "Lidar data" and "Lidar range to XYZ".
std::unique_ptr<PacketDecoder> MakeOusterDecoder(const OusterSheet& sheet,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
