#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"

/// What a lidar or a depth camera measured, and what a simulation of the same rays says of it.

namespace tera {

/// One measured return, in the sensor's frame S at its own time.
struct RangePoint {
  Vec3 p_S_m = Vec3::Zero();
  TimeNs since_ns = 0;  ///< after the scan's t_ns
  double sigma_m = 0;   ///< of its noise along the ray, as the sensor's model has it
};

struct RangeScan {
  TimeNs t_ns = 0;  ///< as written on it
  std::vector<RangePoint> points;
};

/// Numbers of the mechanisms that act on a whole sensor, named as in effects.yaml, in radians.
///
/// Frames  B link, S sensor as documented, T as it is: p_BT = p_BS + shift_B, R_BT = R_BS R(rpy).
/// Model   reported range (of a depth camera: depth) = factor * true + range_m; reported time =
///         true + offset_s.
struct SensorNumbers {
  static constexpr int kCount = 9;
  enum Index { kX, kY, kZ, kRoll, kPitch, kYaw, kRange, kFactor, kOffset };
  std::array<double, kCount> value = {0, 0, 0, 0, 0, 0, 0, 1, 0};

  Vec3 shift_B_m() const { return {value[kX], value[kY], value[kZ]}; }
  Mat3 R_ST() const { return RotationFromRpy(value[kRoll], value[kPitch], value[kYaw]); }
};

enum class Surface {
  kUnknown,  ///< not to be compared: nothing tells where the sensor was, or what is hit
  kNothing,
  kGround,
  kObstacle,
  kMachine
};

/// What a ray meets in the simulation.
///
/// Frames  W; B the sensor's link at the ray's own time.
struct SimulatedReturn {
  Surface surface = Surface::kUnknown;
  int object = 0;  ///< tells obstacles and parts of machines apart
  double range_m = 0;
  Vec3 normal_W = Vec3::Zero();  ///< unit, towards the sensor
  Pose X_WB = Pose::Identity();
  Vec3 v_WB_mps = Vec3::Zero(), w_WB_radps = Vec3::Zero();
};

/// A ray of a scan: along unit `d_S` from the sensor, `since_ns` after the scan's t_ns.
struct Beam {
  Vec3 d_S = Vec3::UnitX();
  TimeNs since_ns = 0;
};

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
