#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/export/packets/lidar_pattern.h"

namespace tera {

/// One return in the units of a packet.
struct PacketReturn {
  std::uint32_t steps = 0;  ///< range in steps of the format; 0: none
  std::uint8_t reflectivity = 0;
};
/// The returns of one pulse, in the order of the scan's points.
using PulseReturns = std::array<PacketReturn, 2>;

/// Resolution and limit of a format's ranges.
struct RangeSteps {
  double step_m = 0.001;
  std::uint32_t most = 0;
};

/// The returns of one scan, by column and ring.
class PulseGrid {
 public:
  /// Throws InputError at `place` for a point that is not finite or not on a pulse of the
  /// pattern, for more returns than the pattern has, and for a range that the format cannot hold.
  PulseGrid(const LidarScan& scan, const LidarPattern& pattern, const RangeSteps& ranges,
            const std::string& place);

  const PulseReturns& At(int column, std::size_t ring) const {
    return pulses_[static_cast<std::size_t>(column) * rings_ + ring];
  }

 private:
  std::size_t rings_;
  std::vector<PulseReturns> pulses_;
};

}  // namespace tera
