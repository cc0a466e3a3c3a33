#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/motion.h"
#include "survey/align/six_motions.h"

namespace tera {

/// Start of a search, and the overlap it needs.
struct RegistrationRequest {
  Pose X_AB_start = Pose::Identity();
  double gate_m = 1.0;         ///< largest distance between partners at the start
  double voxel_m = 0.1;        ///< thinning: one mean point for each cube of this edge
  double least_overlap = 0.2;  ///< least share of either cloud's points that must have partners
};

enum class RegistrationStatus {
  kRegistered,
  kNoOverlap,     ///< too few points of either have a partner in the other
  kNotConverged,  ///< the pose still moves when the search ends
  kOpen,          ///< the geometry leaves some direction undetermined
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

/// A motion of B that the geometry does not determine, in A. The centre moves along `translation`
/// and B turns about it by the rotation vector `rotation`. The two have length 1 together if
/// rotations count as metres at Registration::reach_m.
struct OpenMotion {
  Vec3 translation = Vec3::Zero(), rotation = Vec3::Zero();
  bool is_turn = false;             ///< a turn about an axis rather than a shift
  Vec3 along = Vec3::Zero();        ///< direction of the axis, or of the shift
  Vec3 through_A_m = Vec3::Zero();  ///< for a turn: the point of its axis nearest to the centre
};

/// The pose of B in A.
///
/// Frames  A, B: the frames of the two clouds. Errors are a translation and a rotation vector, both
///         in A: p_A = Exp(rotation) R_AB p_B + p_AB + translation.
struct Registration {
  RegistrationStatus status = RegistrationStatus::kNotConverged;
  Pose X_AB = Pose::Identity();
  Mat6 covariance = Mat6::Zero();         ///< x, y, z (m), then about x, y, z (rad); at B's origin
  Vec3 centre_A_m = Vec3::Zero();         ///< mean of the partners
  Mat6 centre_covariance = Mat6::Zero();  ///< the same for the point of B at the centre
  double reach_m = 1;  ///< root mean square distance of the partners from the centre
  double overlap_of_A = 0, overlap_of_B = 0;  ///< shares of points that have a partner
  double residual_m = 0;  ///< root mean square distance from B's points to A's planes
  int partners = 0, steps = 0;
  std::vector<OpenMotion> open;
  std::vector<std::string_view>
      open_axes;  ///< axes among x, y, z, roll, pitch, yaw that are mostly open

  /// Whether x, y, z and the rotations about them are observed at the point of B that lies at
  /// `at_A_m`. An axis is observed if no open motion has a part along it. Covariances do not
  /// include open motions and do not bound unobserved axes.
  std::array<bool, 6> ObservedAt(const Vec3& at_A_m) const;
};

constexpr std::array<std::string_view, 6> kPoseAxes = {"x", "y", "z", "roll", "pitch", "yaw"};

/// Aligns B with A.
///
/// Model   PCL's GICP brings B near from the start, with gates that halve down to 3 voxels.
///         Gauss-Newton steps then minimise Tukey's loss of the distances n . (X p - m). These are
///         distances from B's points to the planes of their partners in A; each step renews the
///         partners. m and n are mean and normal of a point's 16 neighbours if these lie in a
///         plane.
///         A direction is open if noise of the normals explains at least half of its information H
///         = sum w J' J. B keeps its pose along open directions.
///         The covariance is the sandwich (H - N)^-1 M (H - N)^-1. N is the part of H that is noise
///         of the normals; M is the covariance of the gradient sum w J' r. M takes the larger of
///         two estimates along each direction. The first propagates independent noise of each
///         point: B's by its own r, A's through all planes that contain the point. The second sums
///         g g' over blocks of neighbours and so covers errors that neighbours share, whatever
///         their cause.
/// Omits   a wrong minimum far from the start; errors that all points of a scan share (scale, tilt
///         of beams, motion during the scan).
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP"; Liang and Zeger 1986 (sandwich over
///         blocks); Fuller 1987, "Measurement error models" (noise in the regressors).
Registration Register(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                      const RegistrationRequest& request);

}  // namespace tera
