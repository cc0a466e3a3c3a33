#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "resimulate/range_scan.h"
#include "resimulate/sensor_numbers.h"
#include "resimulate/simulated_return.h"

/// What a lidar or a depth camera measured, and what a simulation of the same rays says of it.

namespace tera {

/// One sensor's scans beside the simulation of them.
struct RangeSource {
  std::string channel;        ///< "excavator1/lidar_roof"
  std::string target;         ///< the sensor's name in the scenario
  bool planar_depth = false;  ///< a camera's: depth is along x of S
  Pose X_BS = Pose::Identity();
  SensorNumbers present;  ///< as the scenario has them
  TimeNs start_ns = 0;    ///< of the recording
  std::vector<RangeScan> scans;
  /// Casts rays of a scan under numbers that the sensor might have.
  std::function<std::vector<SimulatedReturn>(std::size_t scan, const SensorNumbers& numbers,
                                             const std::vector<Beam>& beams)>
      cast;
  /// Height of the simulated ground at the time of a scan; nothing beyond the site.
  std::function<std::optional<double>(std::size_t scan, const Vec2& xy_W_m)> ground_m;
  /// Name of an object.
  std::function<std::string(int object)> name_of;
};

/// The point as it truly was in the frame T, were `numbers` the sensor's.
Vec3 TruePoint(const RangeSource& source, const SensorNumbers& numbers, const Vec3& p_S_m);

/// The same in W, `hit` being of its ray.
Vec3 PointInWorld(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
                  const SimulatedReturn& hit);

/// How far the point lies behind the simulated surface that its ray meets, along the normal.
double BeyondSurface_m(const RangeSource& source, const SensorNumbers& numbers,
                       const RangePoint& point, const SimulatedReturn& hit);

/// The ray of a point.
Beam BeamOf(const RangePoint& point);

}  // namespace tera
