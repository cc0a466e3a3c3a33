#pragma once

#include <array>
#include <filesystem>

#include "dataset/import/scans/packet_decoder.h"

namespace tera {

inline constexpr std::size_t kQt64Lasers = 64;

/// Where the lasers of a PandarQT point: elevations upward, azimuths clockwise from above.
struct PandarAngles {
  std::array<double, kQt64Lasers> elevation_deg{}, azimuth_deg{};
};

/// The design's angles; each unit has its own in its file.
PandarAngles Qt64DesignAngles();
/// A unit's own, as its calibration file has them: "Laser id,Elevation,Azimuth", a row a laser.
PandarAngles ReadPandarAngles(const std::filesystem::path& file);

/// Packets of a Hesai PandarQT (QT64).
///
/// Frames  S: the manual's y is forward, x of S; its x is right, -y of S.
/// Model   laser n of a block at azimuth A: alpha = A + azimuth_n,
///         (r cos w cos alpha, -r cos w sin alpha, r sin w). Blocks of a dual return come in pairs.
///         A scan goes from azimuth 0, which looks forward, to the next.
/// Source  PandarQT User Manual Q01-en, "Point cloud data packet" and appendix I; angles of the
///         design and firing times as tier4/nebula lists them.
std::unique_ptr<PacketDecoder> MakePandarDecoder(const PandarAngles& angles,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
