#pragma once

#include <memory>

#include "dataset/import/scans/packet_decoder.h"
#include "dataset/import/scans/velodyne_units.h"

namespace tera {

/// Decoder for packets of a Velodyne.
///
/// Frames  S: the manual's y points forward and is x of S; its x points right and is -y of S.
/// Model   laser n of a block at azimuth A, elevation w_n: alpha = A + dA t_n / T + offset_n. t_n
///         is the time since the block's start, T the block's duration and dA the turn until the
///         next block. Position: (r cos w cos alpha, -r cos w sin alpha, r sin w + origin_z_n).
///         Blocks of a dual return come in pairs: the last return, then the strongest or second
///         strongest. A scan begins at azimuth 0, which is forward.
/// Omits   the split of reflectivity at 100 between diffuse and retroreflective targets: 0 to 255
///         map linearly to 0 to 1.
/// Source  the manuals, "Calculating X,Y,Z coordinates" and "Precision azimuth calculation".
std::unique_ptr<PacketDecoder> MakeVelodyneDecoder(const VelodyneUnit& unit,
                                                   const DecodeOptions& options, TakeScan take);

}  // namespace tera
