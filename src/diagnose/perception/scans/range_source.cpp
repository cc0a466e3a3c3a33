#include "diagnose/perception/scans/range_source.h"

namespace tera {

double ReportedRange_m(const RangeSource& source, const Vec3& p_S_m) {
  return source.planar_depth ? p_S_m.x() : p_S_m.norm();
}

Vec3 TruePoint(const RangeSource& source, const SensorCalibration& calibration, const Vec3& p_S_m) {
  const double reported_m = ReportedRange_m(source, p_S_m);
  const double true_m = (reported_m - calibration.range_bias_m) / calibration.range_factor;
  return p_S_m * (true_m / reported_m);
}

Vec3 PointInWorld(const RangeSource& source, const SensorCalibration& calibration,
                  const RangePoint& point, const SimulatedReturn& hit) {
  return hit.X_WB * Vec3(calibration.X_BT * TruePoint(source, calibration, point.p_S_m));
}

Vec3 RayDirection_W(const SensorCalibration& calibration, const RangePoint& point,
                    const SimulatedReturn& hit) {
  return hit.X_WB.linear() * (calibration.X_BT.linear() * point.p_S_m.normalized());
}

double PointToPlane_m(const RangeSource& source, const SensorCalibration& calibration,
                      const RangePoint& point, const SimulatedReturn& hit) {
  const double true_m = TruePoint(source, calibration, point.p_S_m).norm();
  return -hit.normal_W.dot(RayDirection_W(calibration, point, hit)) * (true_m - hit.range_m);
}

PointFlags NoPoints(const std::vector<RangeScan>& scans) {
  PointFlags none;
  for (const RangeScan& scan : scans) none.emplace_back(scan.points.size());
  return none;
}

Beam BeamOf(const RangePoint& point) { return {point.p_S_m.normalized(), point.since_ns}; }

std::vector<Beam> BeamsOf(const RangeScan& scan) {
  std::vector<Beam> beams;
  for (const RangePoint& point : scan.points) beams.push_back(BeamOf(point));
  return beams;
}

}  // namespace tera
