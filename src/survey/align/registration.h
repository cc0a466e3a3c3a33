#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/motion.h"
#include "survey/align/six_motions.h"

namespace tera {

/// Where a search begins, and what it takes for the same place.
struct RegistrationRequest {
  Pose X_AB_start = Pose::Identity();
  double gate_m = 1.0;         ///< farthest that a point may be from its partner at the start
  double voxel_m = 0.1;        ///< points are thinned to one in a cube of it, their mean
  double least_overlap = 0.2;  ///< share of one of the two that must have partners
};

enum class RegistrationStatus {
  kRegistered,
  kNoOverlap,     ///< too few points of either have a partner in the other
  kNotConverged,  ///< the pose still moves when the search ends
  kOpen,          ///< along some direction the geometry tells nothing
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

/// A motion of B that the geometry does not tell: of the centre along `translation`, and about it
/// along the rotation vector `rotation`, both in A, of length 1 together when rotations are counted
/// as metres at Registration::reach_m.
struct OpenMotion {
  Vec3 translation = Vec3::Zero(), rotation = Vec3::Zero();
  bool is_turn = false;             ///< that it is a turn about an axis rather than a shift
  Vec3 along = Vec3::Zero();        ///< direction of the axis, or of the shift
  Vec3 through_A_m = Vec3::Zero();  ///< of a turn: the point of its axis next to the centre
};

/// How B lies in A.
///
/// Frames  A, B: those of the two clouds. Errors are a translation and a rotation vector, both in
///         A: p_A = Exp(rotation) R_AB p_B + p_AB + translation.
struct Registration {
  RegistrationStatus status = RegistrationStatus::kNotConverged;
  Pose X_AB = Pose::Identity();
  Mat6 covariance = Mat6::Zero();         ///< x, y, z (m), then about x, y, z (rad); of B's origin
  Vec3 centre_A_m = Vec3::Zero();         ///< mean of the partners
  Mat6 centre_covariance = Mat6::Zero();  ///< the same of the point of B that lies there
  double reach_m = 1;  ///< root mean square distance of the partners from the centre
  double overlap_of_A = 0, overlap_of_B = 0;  ///< shares of their points with a partner
  double residual_m = 0;  ///< root mean square distance of B's points from A's planes
  int partners = 0, steps = 0;
  std::vector<OpenMotion> open;
  std::vector<std::string_view> open_axes;  ///< those of x, y, z, roll, pitch, yaw mostly open

  /// Whether x, y, z and the turns about them are observed, of the point of B that lies at
  /// `at_A_m`: none of the open motions has a part along them. Covariances do not count open
  /// motions, and so are no bound of what is not observed.
  std::array<bool, 6> ObservedAt(const Vec3& at_A_m) const;
};

constexpr std::array<std::string_view, 6> kPoseAxes = {"x", "y", "z", "roll", "pitch", "yaw"};

/// Aligns B with A.
///
/// Model   From the start, PCL's GICP brings B near, with gates that are halved down to 3 voxels.
///         Then Gauss and Newton's steps minimise Tukey's loss of the distances n . (X p - m) of
///         B's points from the planes of their partners in A, partners renewed in each step. m and
///         n are mean and normal of a point's 16 neighbours where these lie in a plane. Along a
///         direction in which the normals' own noise explains at least half of the information
///         H = sum w J' J, the geometry tells nothing: B is left there as it was.
///         Covariance: the sandwich (H - N)^-1 M (H - N)^-1 with N the part of H that is noise of
///         normals, and M the covariance of the gradient sum w J' r: along each direction the
///         larger of two. One propagates noise of each point, of B by its own r, of A through all
///         planes that it is of; the other sums g g' over blocks of neighbours, which holds for
///         what they have in common whatever its cause.
/// Omits   a wrong minimum away from the start; errors that all points of a scan share (scale, tilt
///         of beams, motion during the scan).
/// Source  Segal, Haehnel, Thrun 2009, "Generalized-ICP"; Liang and Zeger 1986 (sandwich over
///         blocks); Fuller 1987, "Measurement error models" (noise in the regressors).
Registration Register(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                      const RegistrationRequest& request);

}  // namespace tera
