#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"

namespace tera {

/// Scan pattern of a spinning lidar, as its sensor.yaml states it.
///
/// Frames  S sensor, x forward, y left, z up. A revolution starts at -x.
struct LidarPattern {
  std::string place;  ///< of the model, for faults
  double rate_hz = 0;
  int columns = 0;
  bool is_clockwise = true;  ///< seen from above
  /// One per ring; azimuths are counter-clockwise from above.
  std::vector<double> elevation_deg, azimuth_offset_deg, firing_us;
  int returns = 1;                 ///< most points of one pulse
  std::string pick = "strongest";  ///< which echo comes first

  std::size_t rings() const { return elevation_deg.size(); }
  double column_us() const { return 1e6 / (rate_hz * columns); }
  /// Start of a column after the start of the revolution.
  TimeNs ColumnStart(int column) const;
  /// Direction of a pulse in S.
  Vec3 Direction(int column, std::size_t ring) const;
};

/// Throws InputError for a lidar whose sensor.yaml has no rings and columns.
LidarPattern ReadLidarPattern(const std::filesystem::path& sensor_folder);

}  // namespace tera
