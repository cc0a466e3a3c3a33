#pragma once

#include <array>
#include <filesystem>

#include "dataset/import/scans/packet_decoder.h"

namespace tera {

inline constexpr std::size_t kQt64Lasers = 64;

/// Laser directions of a PandarQT. Elevation is positive upwards; azimuth is clockwise seen from
/// above.
struct PandarAngles {
  std::array<double, kQt64Lasers> elevation_deg{}, azimuth_deg{};
};

/// Nominal angles. The calibration file of a unit holds its individual angles.
PandarAngles Qt64DesignAngles();
/// Reads the calibration file of a unit: "Laser id,Elevation,Azimuth", one row per laser.
PandarAngles ReadPandarAngles(const std::filesystem::path& file);

/// Decoder for packets of a Hesai PandarQT (QT64).
///
/// Frames  S sensor frame: its x axis is the manual's y (forward), and its y axis is the manual's
///         -x (left).
/// Model   Laser n of a block with azimuth A and elevation w has alpha = A + azimuth_n. Its point
///         is (r cos w cos alpha, -r cos w sin alpha, r sin w). In dual return mode, blocks come in
///         pairs. A scan begins at azimuth 0, which is forward.
/// Source  PandarQT User Manual Q01-en, "Point cloud data packet" and appendix I; nominal angles
///         and firing times as listed in tier4/nebula.
std::unique_ptr<PacketDecoder> MakePandarDecoder(const PandarAngles& angles,
                                                 const DecodeOptions& options, TakeScan take);

}  // namespace tera
