#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dataset/import/scans/packet_decoder.h"

namespace tera {

/// Lasers of a Velodyne from its data sheet, in packet order.
struct VelodyneUnit {
  std::string_view name;
  std::uint8_t factory_byte = 0;
  double range_step_m = 0.002;
  int sequences_per_block = 1;  ///< number of times that all lasers fire per data block
  std::vector<double> elevation_deg, azimuth_offset_deg;
  std::vector<double> origin_z_m;  ///< height of each beam's origin above the sensor origin
  std::vector<double> firing_us;   ///< time from the start of the firing sequence
};

/// Source  VLP-16 User Manual 63-9243, table 9-1 and section 9.4; VLP-32C User Manual 63-9325,
///         tables 9-2 and 9-6 and figures 9-7 and 9-8.
const VelodyneUnit& Vlp16();
const VelodyneUnit& Vlp32c();

/// Decoder for Velodyne packets.
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
