#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/motion.h"
#include "survey/align/six_motions.h"

namespace tera {

/// Initial pose of a registration, and its parameters.
struct RegistrationRequest {
  Pose X_AB_start = Pose::Identity();
  double gate_m = 1.0;   ///< largest distance between partners in the first search
  double voxel_m = 0.1;  ///< edge of the voxels by which clouds are thinned; a voxel keeps its mean
                         ///< point
  double least_overlap = 0.2;  ///< least fraction of each cloud's points that must have a partner
};

enum class RegistrationStatus {
  kRegistered,
  kNoOverlap,     ///< too few points of a cloud have a partner in the other
  kNotConverged,  ///< the pose still changes when the search ends
  kOpen,          ///< the geometry leaves at least one direction undetermined
};

constexpr std::string_view NameOf(RegistrationStatus status) {
  switch (status) {
    case RegistrationStatus::kRegistered:
      return "registered";
    case RegistrationStatus::kNoOverlap:
      return "no_overlap";
    case RegistrationStatus::kNotConverged:
      return "not_converged";
    case RegistrationStatus::kOpen:
      break;
  }
  return "open";
}

/// A motion of B that the geometry does not determine, expressed in A. The centre moves by
/// `translation`, and B rotates about the centre by the rotation vector `rotation`. Their combined
/// length is 1 if 1 rad counts as Registration::reach_m metres.
struct OpenMotion {
  Vec3 translation = Vec3::Zero(), rotation = Vec3::Zero();
  bool is_turn = false;             ///< a rotation about an axis; otherwise a translation
  Vec3 along = Vec3::Zero();        ///< direction of the axis or of the translation
  Vec3 through_A_m = Vec3::Zero();  ///< for a rotation: the point of the axis nearest to the centre
};

/// Result of a registration: the pose of B in A.
///
/// Frames  A, B: frames of the two clouds. An error is a translation and a rotation vector, both
///         expressed in A: p_A = Exp(rotation) R_AB p_B + p_AB + translation.
struct Registration {
  RegistrationStatus status = RegistrationStatus::kNotConverged;
  Pose X_AB = Pose::Identity();
  Mat6 covariance = Mat6::Zero();  ///< of x, y, z (m) and the rotations about x, y, z (rad), at B's
                                   ///< origin
  Vec3 centre_A_m = Vec3::Zero();  ///< mean of the partner points
  Mat6 centre_covariance = Mat6::Zero();  ///< the covariance at the point of B that lies at the
                                          ///< centre
  double reach_m = 1;  ///< root mean square distance of the partners from the centre
  double overlap_of_A = 0, overlap_of_B = 0;  ///< fractions of points that have a partner
  double residual_m = 0;  ///< root mean square distance of B's points from A's planes
  int partners = 0, steps = 0;
  std::vector<OpenMotion> open;
  std::vector<std::string_view> open_axes;  ///< axes among x, y, z, roll, pitch, yaw along which
                                            ///< the open motions mainly point

  /// For x, y, z and the rotations about x, y, z: true if determined at the point of B that lies at
  /// `at_A_m`. An axis is determined if no open motion has a component along it. Covariances
  /// exclude open motions, so they do not bound undetermined axes.
  std::array<bool, 6> ObservedAt(const Vec3& at_A_m) const;
};

constexpr std::array<std::string_view, 6> kPoseAxes = {"x", "y", "z", "roll", "pitch", "yaw"};

/// Aligns B with A.
///
/// Model   First, PCL's GICP brings B close, with partner distances that are halved down to 3
///         voxels. Then Gauss-Newton steps minimise Tukey's loss of the point-to-plane residuals r
///         = n . (X p - m). Each step selects the partners anew. m and n are mean and normal of the
///         16 neighbours of a point of A, if these are planar.
///
///         The information matrix is H = sum w J' J. A direction is open if noise of the normals
///         explains at least half of its information; B keeps its pose along open directions.
///
///         The covariance is the sandwich (H - N)^-1 M (H - N)^-1. N is the part of H that stems
///         from noise of the normals. M is the covariance of the gradient sum w J' r. Along each
///         direction, M is the larger of two estimates. The first assumes independent noise per
///         point: residuals of B's points, and noise of A's points propagated through all planes
///         that contain them. The second sums g g' over blocks of neighbouring points, and so
///         includes errors that neighbours share.
/// Omits   convergence to a wrong minimum far from the start; errors common to all points of a scan
///         (scale, beam tilt, motion during the scan).
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP"; Liang and Zeger 1986 (sandwich over
///         blocks); Fuller 1987, "Measurement error models" (noise in the regressors).
Registration Register(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                      const RegistrationRequest& request);

}  // namespace tera
