#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dataset/import/scans/packet_decoder.h"

namespace tera {

/// Data-sheet values of a Velodyne's lasers, in packet order.
struct VelodyneUnit {
  std::string_view name;
  std::uint8_t factory_byte = 0;
  double range_step_m = 0.002;
  int sequences_per_block = 1;  ///< firings of all lasers
  std::vector<double> elevation_deg, azimuth_offset_deg;
  std::vector<double> origin_z_m;  ///< height of each beam above the sensor's origin
  std::vector<double> firing_us;   ///< after the start of the sequence
};

/// Source  VLP-16 User Manual 63-9243, table 9-1 and section 9.4; VLP-32C User Manual 63-9325,
///         tables 9-2 and 9-6 and figures 9-7 and 9-8.
const VelodyneUnit& Vlp16();
const VelodyneUnit& Vlp32c();

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
