#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "diagnose/perception/registration/registration_search.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"
#include "sensors/ranging.h"

/// Scans of a ranging sensor, and a simulation of the same rays.

namespace tera {

/// Scans of one sensor with their simulation.
///
/// Frames  W; B the sensor's link; S the sensor as documented; T the sensor under a calibration,
///         the frame of its points and rays.
struct RangeSource {
  std::string channel;  ///< "excavator1/lidar_roof"
  std::string target;   ///< the sensor's name in the scenario
  EffectTarget kind = EffectTarget::kLidar;
  bool planar_depth = false;  ///< reports x of a point in S instead of its distance
  Pose X_BS = Pose::Identity();
  Effects present;      ///< of the sensor, as the scenario has them
  TimeNs start_ns = 0;  ///< of the recording
  std::vector<RangeScan> scans;
  /// Casts rays of a scan under a possible calibration of the sensor.
  std::function<std::vector<SimulatedReturn>(std::size_t scan, const SensorCalibration& calibration,
                                             const std::vector<Beam>& beams)>
      cast;
  /// Height of the simulated ground at the time of a scan; nothing beyond the site.
  std::function<std::optional<double>(std::size_t scan, const Vec2& xy_W_m)> ground_m;
  /// Name of an object.
  std::function<std::string(int object)> name_of;

  /// The scenario's calibration.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

/// A place where scene and simulation differ.
struct SceneDifference {
  Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  double p_chosen = 1, p_confirmed = 1;
  /// Distances to the simulated surface on FINAL, without and with it; 0 where there is none.
  double rmse_before_m = 0, rmse_after_m = 0;
  std::vector<std::pair<double, double>> intervals_s;  ///< when; empty: all the time
};

/// Times of the blocks in which a difference is there, among the blocks that tell; none if it
/// always is.
std::vector<std::pair<double, double>> IntervalsOf(const RangeSource& source,
                                                   const ScanSplit& split,
                                                   const std::map<std::size_t, bool>& is_there);

/// The sensor's reported number for a point: range or depth.
double ReportedRange_m(const RangeSource& source, const Vec3& p_S_m);

/// The true position of a point in the frame T, if `calibration` were the sensor's.
Vec3 TruePoint(const RangeSource& source, const SensorCalibration& calibration, const Vec3& p_S_m);

/// The true point in W; `hit` belongs to its ray.
Vec3 PointInWorld(const RangeSource& source, const SensorCalibration& calibration,
                  const RangePoint& point, const SimulatedReturn& hit);

/// The direction of a point's ray in W; `hit` belongs to that ray.
Vec3 RayDirection_W(const SensorCalibration& calibration, const RangePoint& point,
                    const SimulatedReturn& hit);

/// Distance of the point behind the simulated surface on its ray, along the normal.
double PointToPlane_m(const RangeSource& source, const SensorCalibration& calibration,
                      const RangePoint& point, const SimulatedReturn& hit);

/// One flag for each point of each scan. An empty list flags no point.
using PointFlags = std::vector<std::vector<bool>>;

/// Flags for all points of these scans, none set.
PointFlags NoPoints(const std::vector<RangeScan>& scans);

/// The ray of a point, and those of all points of a scan.
Beam BeamOf(const RangePoint& point);
std::vector<Beam> BeamsOf(const RangeScan& scan);

/// Casts the rays of `points` under a calibration. The residual is each point's distance behind the
/// simulated surface on its ray.
///
/// Model   noise along the normal has three parts: the range's times the cosine of incidence, 0.02
///         deg times the range (encoders and poses), and 2 mm of the surface.
/// Source  Chen and Medioni 1992 (distance to planes).
std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorCalibration& calibration);

/// The scans with their sensor's candidate effects. Keeps a reference.
RegistrationBlock BlockOf(const RangeSource& source);

/// Up to `most` points of each scan of the given parts, evenly spread, without the `excluded` ones.
std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const PointFlags& excluded);

/// Up to 400 points of each scan for registration, without the `excluded` ones, which a finding in
/// the scene explains.
SplitPoints PointsToRegister(const RangeSource& source, const ScanSplit& split,
                             const PointFlags& excluded);

}  // namespace tera
