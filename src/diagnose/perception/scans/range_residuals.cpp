#include "diagnose/perception/scans/range_residuals.h"

#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

using Vector = Eigen::Matrix<double, SensorNumbers::kCount, 1>;

constexpr double kAngle_rad = 0.02 * kDeg, kSurface_m = 0.002;
constexpr double kTurn_rad = 1e-6;  ///< for derivatives of a rotation

/// Derivatives of beyond at one hit.
Vector SlopeOf(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
               const SimulatedReturn& hit) {
  const Vec3 p_T_m = TruePoint(source, numbers, point.p_S_m);
  const Mat3 R_WB = hit.X_WB.linear();
  const Vec3 n_B = R_WB.transpose() * hit.normal_W;
  const Vec3 n_S = source.X_BS.linear().transpose() * n_B;
  const Vec3 n_T = numbers.R_ST().transpose() * n_S;
  Vector slope;
  slope.head<3>() = -n_B;
  for (int a = 0; a < 3; ++a) {
    SensorNumbers turned = numbers;
    turned.value[static_cast<std::size_t>(SensorNumbers::kRoll + a)] += kTurn_rad;
    slope[SensorNumbers::kRoll + a] =
        -n_S.dot((turned.R_ST() - numbers.R_ST()) * p_T_m) / kTurn_rad;
  }
  const double reported_m = source.planar_depth ? point.p_S_m.x() : point.p_S_m.norm();
  const double along = -n_T.dot(point.p_S_m) / reported_m;
  const double factor = numbers.value[SensorNumbers::kFactor];
  slope[SensorNumbers::kRange] = -along / factor;
  slope[SensorNumbers::kFactor] =
      -along * (reported_m - numbers.value[SensorNumbers::kRange]) / (factor * factor);
  // What moves with the machine tells little of time.
  slope[SensorNumbers::kOffset] = 0;
  if (hit.surface != Surface::kMachine) {
    const Vec3 p_W_m = PointInWorld(source, numbers, point, hit);
    const Vec3 v_W_mps = hit.v_WB_mps + hit.w_WB_radps.cross(p_W_m - hit.X_WB.translation());
    slope[SensorNumbers::kOffset] = hit.normal_W.dot(v_W_mps);
  }
  return slope;
}

double SigmaOf(const RangeSource& source, const SensorNumbers& numbers, const RangePoint& point,
               const SimulatedReturn& hit) {
  const Vec3 d_W =
      hit.X_WB.linear() * (source.X_BS.linear() * (numbers.R_ST() * point.p_S_m.normalized()));
  const double along = point.sigma_m * hit.normal_W.dot(d_W);
  const double across = kAngle_rad * point.p_S_m.norm();
  return std::sqrt(along * along + across * across + kSurface_m * kSurface_m);
}

}  // namespace

std::vector<PointResidual> ResidualsOf(const RangeSource& source,
                                       const std::vector<ScanPoints>& points,
                                       const SensorNumbers& numbers) {
  std::vector<PointResidual> residuals;
  for (const ScanPoints& of_scan : points) {
    const RangeScan& scan = source.scans[of_scan.scan];
    std::vector<Beam> beams;
    for (const std::size_t p : of_scan.points) beams.push_back(BeamOf(scan.points[p]));
    const std::vector<SimulatedReturn> hits = source.cast(of_scan.scan, numbers, beams);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const RangePoint& point = scan.points[of_scan.points[i]];
      PointResidual residual;
      residual.scan = of_scan.scan;
      residual.surface = hits[i].surface;
      if (residual.is_judged()) {
        residual.beyond = BeyondSurface_m(source, numbers, point, hits[i]);
        residual.sigma = SigmaOf(source, numbers, point, hits[i]);
        residual.slope = SlopeOf(source, numbers, point, hits[i]);
      }
      residuals.push_back(residual);
    }
  }
  return residuals;
}

SensorComparison ComparisonOf(const RangeSource& source) {
  return {source.present, source.present,
          [&source](const std::vector<ScanPoints>& points, const SensorNumbers& numbers, int) {
            return ResidualsOf(source, points, numbers);
          }};
}

}  // namespace tera
