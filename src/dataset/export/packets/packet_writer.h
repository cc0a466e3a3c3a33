#pragma once

#include <string>

#include "core/types/measurement.h"

namespace tera {

/// Writes the packets of one lidar.
class PacketWriter {
 public:
  virtual ~PacketWriter() = default;
  /// The next scan, whose first pulse left at `start_ns` since 1970. Faults are at `place`.
  virtual void Take(const LidarScan& scan, TimeNs start_ns, const std::string& place) = 0;
  /// Writes the last packet and gives the files their names.
  virtual void Finish() = 0;
};

}  // namespace tera
