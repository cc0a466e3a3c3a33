#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "sim/scene_assembly.h"

namespace tera {

/// Entropy in nats of a binary event with probability `p`.
double BinaryEntropy(double p);

/// The box of a person, a vehicle or a part of another machine.
struct Occupant {
  Pose X_WB = Pose::Identity();
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
};
/// All current occupants except the parts of machine number `machine`.
std::vector<Occupant> OccupantsAt(const Instant& now, const Scenario& scenario,
                                  const SceneAssembly& assembly, std::size_t machine);

/// Information that the ranging sensors of a layout can gain about the positions of people and
/// vehicles: the surrogate metric S-MIG.
///
/// Frames  H as in PolarGrid. The grid is a square in H of twice a radius, upright on the ground
///         below the machine.
/// Model   p_v is the share of the moments at which voxel v of H holds a part of a person or
///         vehicle. It does if its middle lies in the box, grown by half a voxel on every side. The
///         figure is the entropy -p ln p - (1 - p) ln(1 - p), summed over the voxels that a layout
///         covers at a moment. A lidar or depth camera covers a voxel if at least one ray reaches
///         it. The voxel's square face, turned to the sensor, then has a sample within the
///         measuring range (look.h). The occluded figure also requires a free line of sight up to
///         the voxel's near side.
/// Omits   compared with the paper: its grid of one map and many drives; here the grid covers the
///         cycle, and objects at rest in H carry no information. Separate grids for each kind of
///         object; here all share one. The voxels along each ray; the ray density replaces them.
///         Only the second figure has occlusion, which the paper ignores.
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
    std::vector<bool> through, in_sight;  ///< covered voxels: without and with occlusion
  };
  /// Counts the voxels that hold a part of an occupant.
  void Count(const std::vector<Occupant>& occupants, const std::vector<Vec3>& voxels_W_m);

  double voxel_m_;
  std::vector<Vec3> voxels_H_m_;  ///< their middles
  std::vector<int> occupied_;     ///< moments per voxel
  std::vector<Covered> covered_;  ///< one per moment
};

}  // namespace tera
