#pragma once

#include <array>
#include <filesystem>

#include "dataset/import/scans/packet_decoder.h"

namespace tera {

inline constexpr std::size_t kQt64Lasers = 64;

/// Directions of a PandarQT's lasers: elevations upward, azimuths clockwise from above.
struct PandarAngles {
  std::array<double, kQt64Lasers> elevation_deg{}, azimuth_deg{};
};

/// The design's angles; a unit's own angles stand in its calibration file.
PandarAngles Qt64DesignAngles();
/// Reads a unit's calibration file: "Laser id,Elevation,Azimuth", one row for each laser.
PandarAngles ReadPandarAngles(const std::filesystem::path& file);

/// Decoder for packets of a Hesai PandarQT (QT64).
///
/// Frames  S: the manual's y points forward and is x of S; its x points right and is -y of S.
/// Model   laser n of a block at azimuth A: alpha = A + azimuth_n, (r cos w cos alpha, -r cos w sin
///         alpha, r sin w). Blocks of a dual return come in pairs. A scan begins at azimuth 0,
///         which is forward.
/// Source  PandarQT User Manual Q01-en, "Point cloud data packet" and appendix I; angles of the
///         design and firing times as tier4/nebula lists them.
std::unique_ptr<PacketDecoder> MakePandarDecoder(const PandarAngles& angles,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
