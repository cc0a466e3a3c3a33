#pragma once

#include <memory>

#include "dataset/import/scans/packet_decoder.h"
#include "dataset/import/scans/velodyne_units.h"

namespace tera {

/// Decoder for packets of a Velodyne.
///
/// Frames  S sensor frame: its x axis is the manual's y (forward), and its y axis is the manual's
///         -x (left).
/// Model   For laser n of a block with azimuth A: alpha = A + dA t_n / T + offset_n. t_n is the
///         firing time since the start of the block. T is the duration of the block. dA is the
///         azimuth difference to the next block. With elevation w, the point is (r cos w cos alpha,
///         -r cos w sin alpha, r sin w + origin_z_n). In dual return mode, blocks come in pairs:
///         first the last return, then the strongest or second strongest. A scan begins at azimuth
///         0, which is forward.
/// Omits   the split of reflectivity at 100 into diffuse and retroreflective targets: 0 to 255 map
///         linearly to 0 to 1.
/// Source  the manuals, "Calculating X,Y,Z coordinates" and "Precision azimuth calculation".
std::unique_ptr<PacketDecoder> MakeVelodyneDecoder(const VelodyneUnit& unit,
                                                   const DecodeOptions& options, TakeScan take);

}  // namespace tera
