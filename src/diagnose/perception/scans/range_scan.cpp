#include "diagnose/perception/scans/range_scan.h"

namespace tera {
namespace {

/// What a sensor reports of a point as a number: its range, or its depth.
double Reported(const RangeSource& source, const Vec3& p_S_m) {
  return source.planar_depth ? p_S_m.x() : p_S_m.norm();
}

}  // namespace

Vec3 TruePoint(const RangeSource& source, const SensorNumbers& numbers, const Vec3& p_S_m) {
  const double reported_m = Reported(source, p_S_m);
  const double true_m =
      (reported_m - numbers.value[SensorNumbers::kRange]) / numbers.value[SensorNumbers::kFactor];
  return p_S_m * (true_m / reported_m);
}

Vec3 PointInWorld(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
                  const SimulatedReturn& hit) {
  const Vec3 p_BT_m = source.X_BS.translation() + numbers.shift_B_m();
  const Vec3 p_T_m = TruePoint(source, numbers, point.p_S_m);
  return hit.X_WB * Vec3(p_BT_m + source.X_BS.linear() * (numbers.R_ST() * p_T_m));
}

double BeyondSurface_m(const RangeSource& source, const SensorNumbers& numbers,
                       const RangePoint& point, const SimulatedReturn& hit) {
  const Vec3 d_W =
      hit.X_WB.linear() * (source.X_BS.linear() * (numbers.R_ST() * point.p_S_m.normalized()));
  const double true_m = TruePoint(source, numbers, point.p_S_m).norm();
  return -hit.normal_W.dot(d_W) * (true_m - hit.range_m);
}

Beam BeamOf(const RangePoint& point) { return {point.p_S_m.normalized(), point.since_ns}; }

}  // namespace tera
