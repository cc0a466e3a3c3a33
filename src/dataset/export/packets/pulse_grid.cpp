#include "dataset/export/packets/pulse_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "dataset/import/scans/packet_bytes.h"

namespace tera {
namespace {

/// Most angle between a point and its pulse: the resolution of a Velodyne's azimuths.
constexpr double kMostOff_rad = 0.01 * kDeg;

PacketReturn ReturnOf(const LidarPoint& point, double range_m, double step_m) {
  const double reflectivity = std::clamp(point.intensity, 0.0F, 1.0F) * kFullReflectivity;
  return {std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(range_m / step_m))),
          static_cast<std::uint8_t>(std::lround(reflectivity))};
}

}  // namespace

PulseGrid::PulseGrid(const LidarScan& scan, const LidarPattern& pattern, const RangeSteps& ranges,
                     const std::string& place)
    : rings_(pattern.rings()), pulses_(static_cast<std::size_t>(pattern.columns) * rings_) {
  const auto fail = [&](std::size_t k, const std::string& finding) {
    throw InputError(fmt::format("{}: point {}", place, k + 1),
                     {FaultKind::kInconsistent, finding});
  };
  const double most_m = ranges.step_m * ranges.most;
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const LidarPoint& point = scan.points[k];
    const Vec3 p_m(point.x_m, point.y_m, point.z_m);
    if (!p_m.allFinite() || !std::isfinite(point.intensity)) {
      fail(k, fmt::format("has x, y, z and intensity {}, {}, {}, {}; need finite numbers: omit "
                          "points without a return",
                          point.x_m, point.y_m, point.z_m, point.intensity));
    }
    if (point.ring >= rings_) {
      fail(k, fmt::format("is of ring {}, need less than {}", point.ring, rings_));
    }
    const double since_us = 1e-3 * point.time_offset_ns - pattern.firing_us[point.ring];
    const auto column = static_cast<int>(std::lround(since_us / pattern.column_us()));
    const double range_m = p_m.norm();
    if (column < 0 || column >= pattern.columns ||
        (p_m - range_m * pattern.Direction(column, point.ring)).norm() > kMostOff_rad * range_m) {
      fail(k,
           "lies on no pulse of the lidar's pattern at its time; need scans as measured, "
           "neither corrected for motion nor cut");
    }
    if (range_m > most_m + ranges.step_m / 2) {
      fail(k, fmt::format("has the range {:.3f} m, the packets hold at most {:.3f} m; need a "
                          "lower max_range_m in the scenario",
                          range_m, most_m));
    }
    PulseReturns& pulse = pulses_[static_cast<std::size_t>(column) * rings_ + point.ring];
    const auto free = std::find_if(pulse.begin(), pulse.begin() + pattern.returns,
                                   [](const PacketReturn& one) { return one.steps == 0; });
    if (free == pulse.begin() + pattern.returns) {
      fail(k, fmt::format("is a further return of a pulse of {}; need the `returns` of the "
                          "lidar's `beam`",
                          pattern.returns));
    }
    *free = ReturnOf(point, range_m, ranges.step_m);
  }
}

}  // namespace tera
