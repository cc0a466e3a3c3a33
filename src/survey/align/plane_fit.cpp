#include "survey/align/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "survey/points/voxels.h"

namespace tera {
namespace {

struct Partner {
  Vec3 p_m;
  const LocalPlane* plane;
  double residual_m;
};

std::vector<Partner> FindPartners(const PlaneMap& a, const std::vector<Vec3>& b_m, double gate_m) {
  std::vector<Partner> partners;
  for (const Vec3& p : b_m) {
    const int nearest = a.Nearest(p, gate_m);
    if (nearest < 0 || !a.plane(nearest).is_plane) continue;
    const LocalPlane& plane = a.plane(nearest);
    partners.push_back({p, &plane, plane.normal.dot(p - plane.mean_m)});
  }
  return partners;
}

/// Tukey's weights, scaled by the median absolute residual.
std::vector<double> Weights(const std::vector<Partner>& partners) {
  constexpr double kOfNormal = 1.4826, kTukey = 4.685, kLeastScale_m = 1e-4;
  std::vector<double> sizes;
  for (const Partner& partner : partners) sizes.push_back(std::abs(partner.residual_m));
  const double bound_m = kTukey * std::max(kOfNormal * Median(sizes), kLeastScale_m);
  std::vector<double> weights;
  for (const Partner& partner : partners) {
    const double u = partner.residual_m / bound_m;
    weights.push_back(std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0.0);
  }
  return weights;
}

/// Derivative of a distance along `normal` with respect to the six motions.
Vec6 Derivative(const PlaneFit& fit, const Vec3& p_m, const Vec3& normal) {
  Vec6 derivative;
  derivative << normal, (p_m - fit.centre_m).cross(normal) / fit.reach_m;
  return derivative;
}

/// Edge of the blocks: twice the size of the neighbourhoods of the planes.
double BlockEdge_m(const std::vector<Partner>& partners) {
  std::vector<double> radii;
  for (const Partner& partner : partners) radii.push_back(partner.plane->radius_m);
  constexpr double kLeast_m = 1e-3;
  return std::max(4 * Median(radii), kLeast_m);
}

/// Along each direction, the larger of two covariances.
Mat6 LargerOf(const Mat6& a, const Mat6& b) {
  constexpr double kFloor = 1e-12;
  const Mat6 base = a + (kFloor * a.trace() + 1e-300) * Mat6::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat6> ratios(b, base);
  // With base = L L' and V' base V = I, b = base V D V' base.
  const Mat6 back = base * ratios.eigenvectors();
  return back * ratios.eigenvalues().cwiseMax(1.0).asDiagonal() * back.transpose();
}

/// Covariance of the gradient if the noise of points is independent. The noise of B's points is
/// their residual. The noise of A's points acts on all planes that contain them.
Mat6 ScatterOfPoints(const PlaneMap& a, const std::vector<Partner>& partners,
                     const std::vector<double>& weights, const PlaneFit& fit) {
  Mat6 scatter = Mat6::Zero();
  // Derivative of the gradient with respect to each point of A.
  using ByPlace = Eigen::Matrix<double, 6, 3>;
  std::vector<ByPlace> by_point(a.points_m().size(), ByPlace::Zero());
  for (std::size_t k = 0; k < partners.size(); ++k) {
    const Partner& partner = partners[k];
    const Vec6 J = weights[k] * Derivative(fit, partner.p_m, partner.plane->normal);
    scatter += partner.residual_m * partner.residual_m * J * J.transpose();
    const double sigma_m = std::sqrt(partner.plane->noise_m2);
    for (const int point : partner.plane->points) {
      const auto p = static_cast<std::size_t>(point);
      by_point[p] += sigma_m * partner.plane->Influence(partner.p_m, a.points_m()[p]) * J *
                     partner.plane->normal.transpose();
    }
  }
  for (const ByPlace& gradient : by_point) scatter += gradient * gradient.transpose();
  return scatter;
}

/// Covariance of the gradient if points within a block have common errors of any kind.
Mat6 ScatterOfBlocks(const std::vector<Partner>& partners, const std::vector<double>& weights,
                     const PlaneFit& fit) {
  std::vector<Vec3> at_m;
  for (const Partner& partner : partners) at_m.push_back(partner.p_m);
  const Voxels blocks = GroupByVoxel(at_m, BlockEdge_m(partners));
  std::vector<Vec6> of_block(blocks.count.size(), Vec6::Zero());
  for (std::size_t k = 0; k < partners.size(); ++k) {
    const Vec6 J = Derivative(fit, partners[k].p_m, partners[k].plane->normal);
    of_block[static_cast<std::size_t>(blocks.of_point[k])] +=
        weights[k] * partners[k].residual_m * J;
  }
  Mat6 scatter = Mat6::Zero();
  for (const Vec6& gradient : of_block) scatter += gradient * gradient.transpose();
  return scatter;
}

void SumUp(const std::vector<Partner>& partners, const std::vector<double>& weights,
           PlaneFit* fit) {
  double squares_m2 = 0, weight = 0;
  for (std::size_t k = 0; k < partners.size(); ++k) {
    const Partner& partner = partners[k];
    const LocalPlane& plane = *partner.plane;
    const double w = weights[k];
    const Vec6 J = Derivative(*fit, partner.p_m, plane.normal);
    const Vec6 along = Derivative(*fit, partner.p_m, plane.along);
    const Vec6 across = Derivative(*fit, partner.p_m, plane.across);
    fit->information += w * J * J.transpose();
    fit->noise += w * (plane.tilt_along_rad2() * along * along.transpose() +
                       plane.tilt_across_rad2() * across * across.transpose());
    fit->gradient += w * partner.residual_m * J;
    squares_m2 += w * partner.residual_m * partner.residual_m;
    weight += w;
  }
  fit->residual_m = weight > 0 ? std::sqrt(squares_m2 / weight) : 0;
}

}  // namespace

PlaneFit FitPlanes(const PlaneMap& a, const std::vector<Vec3>& b_m, double gate_m) {
  const std::vector<Partner> partners = FindPartners(a, b_m, gate_m);
  PlaneFit fit;
  fit.partners = static_cast<int>(partners.size());
  if (partners.empty()) return fit;
  for (const Partner& partner : partners) {
    fit.centre_m += partner.p_m / static_cast<double>(partners.size());
  }
  double squares_m2 = 0;
  for (const Partner& partner : partners) {
    squares_m2 += (partner.p_m - fit.centre_m).squaredNorm();
  }
  constexpr double kLeastReach_m = 1e-3;
  fit.reach_m =
      std::max(std::sqrt(squares_m2 / static_cast<double>(partners.size())), kLeastReach_m);
  const std::vector<double> weights = Weights(partners);
  SumUp(partners, weights, &fit);
  fit.scatter =
      LargerOf(ScatterOfPoints(a, partners, weights, fit), ScatterOfBlocks(partners, weights, fit));
  return fit;
}

ToldMotions SplitMotions(const PlaneFit& fit) {
  // Information below this fraction of the largest is due to rounding.
  constexpr double kFloor = 1e-6, kLeastSignal = 0.5;
  const double most = Eigen::SelfAdjointEigenSolver<Mat6>(fit.information).eigenvalues()[5];
  const Mat6 floor = std::max(kFloor * most, 1e-12) * Mat6::Identity();
  const Mat6 total = fit.information + 2 * floor;
  const Mat6 signal = fit.information - fit.noise;
  // (H - N) e = share H e.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat6> shares(signal, total);
  int open = 0;
  while (open < 6 && shares.eigenvalues()[open] < kLeastSignal) ++open;
  const Mat6 basis =
      Eigen::HouseholderQR<Mat6>(shares.eigenvectors()).householderQ() * Mat6::Identity();
  return {basis.rightCols(6 - open), basis.leftCols(open)};
}

}  // namespace tera
