#pragma once

#include "dataset/import/scans/ouster_sheet.h"
#include "dataset/import/scans/packet_decoder.h"

namespace tera {

/// Decoder for Ouster packets.
///
/// Frames  L lidar frame, x towards the connector; S sensor frame, given by the metadata's
///         transform to L.
/// Model   Column m of M has the encoder angle theta = 2 pi (1 - m / M). Beam i has altitude phi_i
///         and azimuth theta_i = theta - azimuth_i. For range r and n = |(b_x, 0, b_z)|, where
///         (b_x, 0, b_z) is the origin of the beams in L: x = (r - n) cos theta_i cos phi_i + b_x
///         cos theta, y likewise with sines, z = (r - n) sin phi_i + b_z. A scan consists of the
///         packets with the same frame number; each column has its own stamp. Columns not marked
///         valid contain no rays. A second return without a first one is treated as the only
///         return. Ring 0 is the top beam.
/// Omits   signal and near-infrared. A packet that arrives after packets of the next frame is a
///         fault.
/// Source  Ouster Firmware User Manual, "Lidar data" and "Lidar range to XYZ".
std::unique_ptr<PacketDecoder> MakeOusterDecoder(const OusterSheet& sheet,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
