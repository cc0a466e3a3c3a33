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

namespace tera {

/// Scans of one ranging sensor and the simulation of their rays.
///
/// Frames  W world; B the sensor's link; S the sensor as documented; T the sensor under a
///         calibration. Points and rays of a calibration are in T.
struct RangeSource {
  std::string channel;  ///< "excavator1/lidar_roof"
  std::string target;   ///< the sensor's name in the scenario
  EffectTarget kind = EffectTarget::kLidar;
  bool planar_depth = false;  ///< true if the sensor reports x of a point in S, not its distance
  Pose X_BS = Pose::Identity();
  Effects present;      ///< effects on the sensor in the scenario
  TimeNs start_ns = 0;  ///< start of the recording
  std::vector<RangeScan> scans;
  /// Casts rays of a scan, with the sensor under the given calibration.
  std::function<std::vector<SimulatedReturn>(std::size_t scan, const SensorCalibration& calibration,
                                             const std::vector<Beam>& beams)>
      cast;
  /// Height of the simulated ground at the time of a scan. Returns nothing outside the site.
  std::function<std::optional<double>(std::size_t scan, const Vec2& xy_W_m)> ground_m;
  std::function<std::string(int object)> name_of;

  /// Calibration of the sensor in the scenario.
  SensorCalibration calibration() const { return CalibrationUnder(X_BS, present); }
};

/// A place where the real scene differs from the simulated one: centre and bounding box.
struct SceneDifference {
  Vec2 centre_W_m = Vec2::Zero(), low_W_m = Vec2::Zero(), high_W_m = Vec2::Zero();
  double p_chosen = 1, p_confirmed = 1;
  /// RMS distance to the simulated surface on FINAL, without and with the difference. 0 if not
  /// computed.
  double rmse_before_m = 0, rmse_after_m = 0;
  std::vector<std::pair<double, double>> intervals_s;  ///< times of the difference; empty: always
};

/// Times of the blocks in which a difference is there, among the blocks that tell; none if it
/// always is.
std::vector<std::pair<double, double>> IntervalsOf(const RangeSource& source,
                                                   const ScanSplit& split,
                                                   const std::map<std::size_t, bool>& is_there);

/// The sensor's reported number for a point: range or depth.
double ReportedRange_m(const RangeSource& source, const Vec3& p_S_m);

/// Position of a measured point in T after the errors of `calibration` are removed.
Vec3 TruePoint(const RangeSource& source, const SensorCalibration& calibration, const Vec3& p_S_m);

/// Position of a measured point in W after the errors of `calibration` are removed. `hit` is the
/// simulated return of its ray.
Vec3 PointInWorld(const RangeSource& source, const SensorCalibration& calibration,
                  const RangePoint& point, const SimulatedReturn& hit);

/// Direction of a point's ray in W. `hit` is the simulated return of this ray.
Vec3 RayDirection_W(const SensorCalibration& calibration, const RangePoint& point,
                    const SimulatedReturn& hit);

/// Distance of a measured point to the simulated surface that its ray hits, along the normal.
/// Positive behind the surface.
double PointToPlane_m(const RangeSource& source, const SensorCalibration& calibration,
                      const RangePoint& point, const SimulatedReturn& hit);

/// One flag per point of each scan. An empty list flags no point.
using PointFlags = std::vector<std::vector<bool>>;

/// Cleared flags for all points of the scans.
PointFlags NoPoints(const std::vector<RangeScan>& scans);

Beam BeamOf(const RangePoint& point);
std::vector<Beam> BeamsOf(const RangeScan& scan);

/// Casts the rays of `points` under a calibration. A residual is the distance of a point behind the
/// simulated surface on its ray.
///
/// Model   The noise along the normal combines three parts: the range noise times the cosine of
///         incidence; 0.02 deg times the range, for encoders and poses; 2 mm of surface resolution.
/// Source  Chen and Medioni 1992 (point-to-plane distance).
std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorCalibration& calibration);

/// The search input of a ranging sensor. Keeps a reference to `source`.
RegistrationBlock BlockOf(const RangeSource& source);

/// At most `most` points per scan of the given parts, evenly spread, without the `excluded` points.
std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const PointFlags& excluded);

/// At most 400 points per scan, for registration. A finding in the scene explains the `excluded`
/// points.
SplitPoints PointsToRegister(const RangeSource& source, const ScanSplit& split,
                             const PointFlags& excluded);

}  // namespace tera
