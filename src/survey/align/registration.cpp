#include "survey/align/registration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "survey/align/coarse_alignment.h"
#include "survey/align/plane_fit.h"
#include "survey/points/voxels.h"

namespace tera {
namespace {

constexpr int kMostSteps = 50;
constexpr double kStill_m = 1e-5;  ///< a smaller step ends the search
constexpr int kLeastPartners = 30;

std::vector<Vec3> Moved(const std::vector<Vec3>& p_m, const Pose& X) {
  std::vector<Vec3> moved;
  moved.reserve(p_m.size());
  for (const Vec3& p : p_m) moved.push_back(X * p);
  return moved;
}

Vec3 MeanOf(const std::vector<Vec3>& p_m) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : p_m) sum += p;
  return sum / static_cast<double>(p_m.size());
}

/// Change of pose for a vector of six motions: a translation, and a rotation about the centre.
Pose MoveOf(const PlaneFit& fit, const Vec6& motion) {
  const Vec3 rotation = motion.tail<3>() / fit.reach_m;
  const double angle = rotation.norm();
  Mat3 R = Mat3::Identity();
  if (angle > 0) R = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  return MakePose(fit.centre_m + motion.head<3>() - R * fit.centre_m, R);
}

double ShareNear(const PlaneMap& map, const std::vector<Vec3>& p_m, double gate_m) {
  std::size_t near = 0;
  for (const Vec3& p : p_m) near += map.Nearest(p, gate_m) >= 0 ? 1 : 0;
  return static_cast<double>(near) / static_cast<double>(p_m.size());
}

/// Performs Gauss-Newton steps from `X`. Returns true if they converge.
bool Refine(const PlaneMap& a, const std::vector<Vec3>& b_m, double gate_m, Pose* X,
            Registration* result) {
  for (int step = 0; step < kMostSteps; ++step) {
    const PlaneFit fit = FitPlanes(a, Moved(b_m, *X), gate_m);
    if (fit.partners < kLeastPartners) return false;
    const auto told = SplitMotions(fit).told;
    if (told.cols() == 0) return true;
    const Eigen::MatrixXd H = told.transpose() * fit.information * told;
    // Later steps are shortened, because a change of partners could otherwise keep the pose moving.
    constexpr int kFullSteps = 15;
    const double length = step < kFullSteps ? 1.0 : kFullSteps / (1.0 + step);
    const Vec6 motion = -length * told * H.ldlt().solve(told.transpose() * fit.gradient);
    *X = MoveOf(fit, motion) * *X;
    X->linear() = Quat(X->linear()).normalized().toRotationMatrix();
    result->steps = step + 1;
    // A step below a hundredth of the fit's standard deviation also ends the search.
    constexpr double kOfSigma = 0.01;
    const double sigma_m = fit.residual_m / std::sqrt(static_cast<double>(fit.partners));
    if (motion.norm() < std::max(kStill_m, kOfSigma * sigma_m)) return true;
  }
  return false;
}

/// Converts rotations from metres at the distance `reach_m` to radians.
Mat6 ToRadians(const Mat6& covariance_m2, double reach_m) {
  Vec6 scale = Vec6::Ones();
  scale.tail<3>() /= reach_m;
  return scale.asDiagonal() * covariance_m2 * scale.asDiagonal();
}

/// Covariance at another point. A rotation about the centre displaces that point too.
Mat6 CovarianceAt(const Mat6& of_centre, const Vec3& from_centre_m) {
  Mat6 move = Mat6::Identity();
  // rotation x d = -[d] rotation
  move.topRightCorner<3, 3>() << 0, from_centre_m.z(), -from_centre_m.y(), -from_centre_m.z(), 0,
      from_centre_m.x(), from_centre_m.y(), -from_centre_m.x(), 0;
  return move * of_centre * move.transpose();
}

OpenMotion OpenMotionOf(const Vec6& motion, const Registration& of) {
  constexpr double kTurn = 0.5;  // fraction of a motion of length 1
  OpenMotion open;
  open.translation = motion.head<3>();
  open.rotation = motion.tail<3>();
  open.is_turn = open.rotation.norm() > kTurn;
  open.along = (open.is_turn ? open.rotation : open.translation).normalized();
  if (open.is_turn) {
    // At this point, the displacement by the rotation and the translation of the centre cancel.
    const Vec3 turn_radpm = open.rotation / of.reach_m;
    open.through_A_m =
        of.centre_A_m + turn_radpm.cross(open.translation) / turn_radpm.squaredNorm();
  }
  return open;
}

void NameOpenMotions(const ToldMotions& motions, Registration* result) {
  constexpr double kMostly = 0.5;
  for (int k = 0; k < motions.open.cols(); ++k) {
    result->open.push_back(OpenMotionOf(motions.open.col(k), *result));
  }
  for (int axis = 0; axis < 6; ++axis) {
    if (motions.open.row(axis).squaredNorm() > kMostly) {
      result->open_axes.push_back(kPoseAxes[static_cast<std::size_t>(axis)]);
    }
  }
}

void StateCovariance(const PlaneFit& fit, const ToldMotions& motions, Registration* result) {
  const auto& told = motions.told;
  if (told.cols() == 0) return;
  const Eigen::MatrixXd signal = told.transpose() * (fit.information - fit.noise) * told;
  const Eigen::MatrixXd inverse =
      signal.ldlt().solve(Eigen::MatrixXd::Identity(told.cols(), told.cols()));
  const Eigen::MatrixXd within = inverse * told.transpose() * fit.scatter * told * inverse;
  result->centre_covariance = ToRadians(told * within * told.transpose(), fit.reach_m);
}

}  // namespace

std::array<bool, 6> Registration::ObservedAt(const Vec3& at_A_m) const {
  constexpr double kLeast = 0.05;  // a twentieth of an open motion of length 1
  Vec6 squares = Vec6::Zero();
  for (const OpenMotion& motion : open) {
    const Vec3 shift =
        motion.translation + (motion.rotation / reach_m).cross(at_A_m - centre_A_m).eval();
    squares.head<3>() += shift.cwiseAbs2();
    squares.tail<3>() += motion.rotation.cwiseAbs2();
  }
  std::array<bool, 6> observed{};
  for (std::size_t k = 0; k < observed.size(); ++k) {
    observed[k] = squares[static_cast<Eigen::Index>(k)] < kLeast * kLeast;
  }
  return observed;
}

Registration Register(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                      const RegistrationRequest& request) {
  // Coordinates are made relative to A's centre, because PCL computes in single precision.
  const Pose X_AM = MakePose(MeanOf(a_m));
  const std::vector<Vec3> a = GroupByVoxel(Moved(a_m, X_AM.inverse()), request.voxel_m).mean_m;
  const std::vector<Vec3> b =
      GroupByVoxel(Moved(b_m, X_AM.inverse() * request.X_AB_start), request.voxel_m).mean_m;
  const double gate_m = std::min(request.gate_m, 3 * request.voxel_m);

  Registration result;
  result.X_AB = request.X_AB_start;
  const auto coarse = AlignByGicp(a, b, request.gate_m, gate_m);
  const PlaneMap map_a(a);
  Pose X = coarse.value_or(Pose::Identity());
  const bool is_still = Refine(map_a, b, gate_m, &X, &result);

  const std::vector<Vec3> b_in_a = Moved(b, X);
  result.overlap_of_B = ShareNear(map_a, b_in_a, gate_m);
  result.overlap_of_A = ShareNear(PlaneMap(b_in_a), a, gate_m);
  const PlaneFit fit = FitPlanes(map_a, b_in_a, gate_m);
  result.partners = fit.partners;
  result.residual_m = fit.residual_m;
  if (fit.partners < kLeastPartners ||
      std::max(result.overlap_of_A, result.overlap_of_B) < request.least_overlap) {
    result.status = RegistrationStatus::kNoOverlap;
    return result;
  }
  const ToldMotions motions = SplitMotions(fit);
  result.X_AB = X_AM * X * X_AM.inverse() * request.X_AB_start;
  result.centre_A_m = X_AM * fit.centre_m;
  result.reach_m = fit.reach_m;
  NameOpenMotions(motions, &result);
  StateCovariance(fit, motions, &result);
  result.covariance =
      CovarianceAt(result.centre_covariance, result.X_AB.translation() - result.centre_A_m);
  result.status = !is_still             ? RegistrationStatus::kNotConverged
                  : result.open.empty() ? RegistrationStatus::kRegistered
                                        : RegistrationStatus::kOpen;
  return result;
}

}  // namespace tera
