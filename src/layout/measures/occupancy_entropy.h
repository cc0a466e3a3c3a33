#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "sim/scene_assembly.h"

namespace tera {

/// Entropy of a yes or no of probability `p`, in nats.
double BinaryEntropy(double p);

/// The box of a person, a vehicle or a part of another machine.
struct Occupant {
  Pose X_WB = Pose::Identity();
  Vec3 low_B_m = Vec3::Zero(), high_B_m = Vec3::Zero();
};
/// All of them now but for the parts of machine number `machine` itself.
std::vector<Occupant> OccupantsAt(const Instant& now, const Scenario& scenario,
                                  const SceneAssembly& assembly, std::size_t machine);

/// How much the sensors of a layout that measure ranges can learn about where people and vehicles
/// are: the surrogate metric S-MIG.
///
/// Frames  H as in PolarGrid. The grid is a square in H of twice a radius, upright on the ground
///         below the machine.
/// Model   p_v, the share of the moments at which voxel v of H holds a part of a person or vehicle
///         (its middle lies in the box, grown by half a voxel on every side); the entropy
///         -p ln p - (1 - p) ln(1 - p), summed over the voxels that a layout covers at a moment. A
///         voxel is covered by a lidar or a camera of depth that sends at least one ray into it: of
///         whose samples its square face, turned to the sensor, takes one or more, in reach of what
///         it measures (look.h). Occluded, with nothing in the way up to the voxel's near side.
/// Omits   against the paper: its grid of one map and many drives, which here is the cycle alone,
///         so that what stands still in H for all of it carries no information; grids of each kind
///         of object, which here are one; the voxels along each single ray, for which the density
///         of rays stands. Occlusion, which the paper ignores, is in the second figure alone.
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
    std::vector<bool> through, in_sight;  ///< of each voxel: whatever is in the way; with nothing
  };
  /// Adds what holds a part of somebody or something now.
  void Count(const std::vector<Occupant>& occupants, const std::vector<Vec3>& voxels_W_m);

  double voxel_m_;
  std::vector<Vec3> voxels_H_m_;  ///< their middles
  std::vector<int> occupied_;     ///< moments, of each voxel
  std::vector<Covered> covered_;  ///< of each moment
};

}  // namespace tera
