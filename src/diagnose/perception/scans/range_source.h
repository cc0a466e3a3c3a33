#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"
#include "sensors/ranging.h"

/// What a sensor that measures ranges measured, and what a simulation of the same rays says of it.

namespace tera {

/// One sensor's scans beside the simulation of them.
///
/// Frames  W; B the sensor's link; S the sensor as documented; T the sensor as a calibration has
/// it,
///         in which its points and rays are then meant.
struct RangeSource {
  std::string channel;  ///< "excavator1/lidar_roof"
  std::string target;   ///< the sensor's name in the scenario
  EffectTarget kind = EffectTarget::kLidar;
  bool planar_depth = false;  ///< what it reports is x of a point in S, not its distance
  Pose X_BS = Pose::Identity();
  Effects present;      ///< of the sensor, as the scenario has them
  TimeNs start_ns = 0;  ///< of the recording
  std::vector<RangeScan> scans;
  /// Casts rays of a scan under a calibration that the sensor might have.
  std::function<std::vector<SimulatedReturn>(std::size_t scan, const SensorCalibration& calibration,
                                             const std::vector<Beam>& beams)>
      cast;
  /// Height of the simulated ground at the time of a scan; nothing beyond the site.
  std::function<std::optional<double>(std::size_t scan, const Vec2& xy_W_m)> ground_m;
  /// Name of an object.
  std::function<std::string(int object)> name_of;

  /// The calibration that the scenario has.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

/// What the sensor reports of a point as a number: its range, or its depth.
double ReportedRange_m(const RangeSource& source, const Vec3& p_S_m);

/// The point as it truly was in the frame T, were `calibration` the sensor's.
Vec3 TruePoint(const RangeSource& source, const SensorCalibration& calibration, const Vec3& p_S_m);

/// The true point in W; `hit` is of its ray.
Vec3 PointInWorld(const RangeSource& source, const SensorCalibration& calibration,
                  const RangePoint& point, const SimulatedReturn& hit);

/// The direction of a point's ray in W; `hit` is of that ray.
Vec3 RayDirection_W(const SensorCalibration& calibration, const RangePoint& point,
                    const SimulatedReturn& hit);

/// How far the point lies behind the simulated surface that its ray meets, along the normal.
double PointToPlane_m(const RangeSource& source, const SensorCalibration& calibration,
                      const RangePoint& point, const SimulatedReturn& hit);

/// One flag for each point of each scan. An empty list flags no point.
using PointFlags = std::vector<std::vector<bool>>;

/// Flags for all points of these scans, none of them set.
PointFlags NoPoints(const std::vector<RangeScan>& scans);

/// The ray of a point, and those of all points of a scan.
Beam BeamOf(const RangePoint& point);
std::vector<Beam> BeamsOf(const RangeScan& scan);

}  // namespace tera
