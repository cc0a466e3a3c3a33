#include "diagnose/perception/scans/range_source.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/units.h"
#include "diagnose/perception/registration/registration_block.h"

namespace tera {

std::vector<std::pair<double, double>> IntervalsOf(const RangeSource& source,
                                                   const ScanSplit& split,
                                                   const std::map<std::size_t, bool>& is_there) {
  std::vector<std::pair<double, double>> intervals_s;
  bool open = false, always = true;
  for (std::size_t s = 0; s < source.scans.size(); ++s) {
    const auto at = is_there.find(split.block[s]);
    if (at == is_there.end()) continue;
    always = always && at->second;
    const double t_s = ToSeconds(source.scans[s].t_ns - source.start_ns);
    if (at->second && !open) intervals_s.emplace_back(t_s, t_s);
    if (at->second) intervals_s.back().second = t_s;
    open = at->second;
  }
  if (always) intervals_s.clear();
  return intervals_s;
}

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

namespace {

constexpr std::size_t kMostPointsOfScan = 400;  ///< maximum per scan in a registration
/// Added to the range noise: angular error of encoders and poses; resolution of the surface mesh.
constexpr double kDirectionSigma_rad = 0.02 * kDeg, kSurfaceSigma_m = 0.002;

/// Derivatives of the distance to the hit surface.
CalibrationVector DerivativeOf(const RangeSource& source, const SensorCalibration& calibration,
                               const RangePoint& point, const SimulatedReturn& hit) {
  const Mat3 R_BT = calibration.X_BT.linear();
  const Vec3 r_B_m = R_BT * TruePoint(source, calibration, point.p_S_m);
  const Vec3 n_B = hit.X_WB.linear().transpose() * hit.normal_W;
  const Vec3 n_T = R_BT.transpose() * n_B;
  CalibrationVector derivative;
  derivative.segment<3>(kShiftOfMount) = -n_B;
  derivative.segment<3>(kTurnOfMount) = n_B.cross(r_B_m);
  const double reported_m = ReportedRange_m(source, point.p_S_m);
  const double along = -n_T.dot(point.p_S_m) / reported_m;
  const double factor = calibration.range_factor;
  derivative[kRangeBias] = -along / factor;
  derivative[kRangeFactor] = -along * (reported_m - calibration.range_bias_m) / (factor * factor);
  // Points on the machine itself carry little information on time.
  derivative[kClockOffset] = 0;
  if (hit.surface != Surface::kMachine) {
    const Vec3 p_W_m = PointInWorld(source, calibration, point, hit);
    const Vec3 v_W_mps = hit.v_WB_mps + hit.w_WB_radps.cross(p_W_m - hit.X_WB.translation());
    derivative[kClockOffset] = hit.normal_W.dot(v_W_mps);
  }
  return derivative;
}

double SigmaOf(const SensorCalibration& calibration, const RangePoint& point,
               const SimulatedReturn& hit) {
  const double along = point.sigma_m * hit.normal_W.dot(RayDirection_W(calibration, point, hit));
  const double across = kDirectionSigma_rad * point.p_S_m.norm();
  return std::sqrt(along * along + across * across + kSurfaceSigma_m * kSurfaceSigma_m);
}

}  // namespace

std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorCalibration& calibration) {
  std::vector<PointResidual> residuals;
  for (const ScanPoints& of_scan : points) {
    const RangeScan& scan = source.scans[of_scan.scan];
    std::vector<Beam> beams;
    for (const std::size_t p : of_scan.points) beams.push_back(BeamOf(scan.points[p]));
    const std::vector<SimulatedReturn> hits = source.cast(of_scan.scan, calibration, beams);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const RangePoint& point = scan.points[of_scan.points[i]];
      PointResidual residual;
      residual.scan = of_scan.scan;
      residual.surface = hits[i].surface;
      if (residual.is_judged()) {
        residual.distance = PointToPlane_m(source, calibration, point, hits[i]);
        residual.sigma = SigmaOf(calibration, point, hits[i]);
        residual.by_calibration = DerivativeOf(source, calibration, point, hits[i]);
      }
      residuals.push_back(residual);
    }
  }
  return residuals;
}

RegistrationBlock BlockOf(const RangeSource& source) {
  return {source.X_BS, source.present,
          CandidatesOf(source.kind, ComparedBy::kRanges, source.target, source.present),
          [&source](const std::vector<ScanPoints>& points, const SensorCalibration& calibration,
                    int) { return ResidualsOf(source, points, calibration); }};
}

std::vector<ScanPoints> PointsOf(const std::vector<RangeScan>& scans, const ScanSplit& split,
                                 const std::vector<Part>& parts, std::size_t most,
                                 const PointFlags& excluded) {
  TERA_CHECK(excluded.empty() || excluded.size() == scans.size(), excluded.size());
  std::vector<ScanPoints> chosen;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    if (std::find(parts.begin(), parts.end(), split.part[s]) == parts.end()) continue;
    ScanPoints of_scan{s, {}};
    const std::size_t count = scans[s].points.size();
    const std::size_t stride = count / most + 1;
    for (std::size_t p = s % stride; p < count; p += stride) {
      if (excluded.empty() || !excluded[s][p]) of_scan.points.push_back(p);
    }
    chosen.push_back(std::move(of_scan));
  }
  return chosen;
}

SplitPoints PointsToRegister(const RangeSource& source, const ScanSplit& split,
                             const PointFlags& excluded) {
  return PointsOfParts(split, [&](const std::vector<Part>& parts) {
    return PointsOf(source.scans, split, parts, kMostPointsOfScan, excluded);
  });
}

}  // namespace tera
