#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "sim/scene_assembly.h"

namespace tera {

/// Entropy in nats of a binary event with probability `p`.
double BinaryEntropy(double p);

/// The bounding box of a person, a vehicle or a part of another machine.
struct Occupant {
  Pose X_WB = Pose::Identity();
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
};
/// All occupants at this moment. Parts of machine number `machine` are excluded.
std::vector<Occupant> OccupantsAt(const Instant& now, const Scenario& scenario,
                                  const SceneAssembly& assembly, std::size_t machine);

/// Information that the ranging sensors of a layout can gain about the positions of people and
/// vehicles: the surrogate metric S-MIG.
///
/// Frames  H as in PolarGrid. The voxel grid stands on the ground below the machine. Its base is a
///         square in H with sides of twice the radius.
/// Model   p_v is the share of the moments at which an occupant fills voxel v. An occupant fills a
///         voxel if the voxel's centre lies in its box, grown by half a voxel on each side. The
///         figure is the entropy -p ln p - (1 - p) ln(1 - p), summed over the voxels that the
///         layout covers at a moment.
///         A lidar or depth camera covers a voxel if at least one ray reaches it: a voxel face
///         turned to the sensor then has at least one sample within the measuring range (look.h).
///         The second figure, "occluded", also requires a free line of sight to the near side of
///         the voxel.
/// Omits   compared with the paper: its grid comes from one map and many drives; the grid here
///         covers the cycle, and objects at rest in H carry no information. The paper has a
///         separate grid for each kind of object; here all kinds share one. The paper traces the
///         voxels along each ray; the ray density replaces this. The paper ignores occlusion, as
///         the first figure does.
/// Source  Hu et al., Investigating the Impact of Multi-LiDAR Placement on Object Detection for
///         Autonomous Driving, arXiv 2105.00373, and its public code, which sums natural
///         logarithms. There the ground covered is 60 m x 40 m x 4 m about a car.
class OccupancyEntropy {
 public:
  OccupancyEntropy(double radius_m, double height_m, double voxel_m);

  void Add(const Pose& X_WH, const std::vector<Occupant>& occupants, const Layout& layout,
           double reflectance, const Sighting& sighting);

  /// p_v of each voxel.
  std::vector<double> Prior() const;
  /// "information/smig" and "information/smig_occluded", in nats.
  std::vector<Figure> Figures() const;

 private:
  struct Covered {
    /// Whether each voxel is covered: ignoring occlusion, and with it.
    std::vector<bool> through, in_sight;
  };
  /// Counts the voxels that hold a part of an occupant.
  void Count(const std::vector<Occupant>& occupants, const std::vector<Vec3>& voxels_W_m);

  double voxel_m_;
  std::vector<Vec3> voxels_H_m_;  ///< voxel centres
  std::vector<int> occupied_;     ///< for each voxel, the number of moments when it is filled
  std::vector<Covered> covered_;  ///< one per moment
};

}  // namespace tera
