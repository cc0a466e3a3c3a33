#pragma once

#include <pcl/kdtree/kdtree_flann.h>

#include <vector>

#include "survey/points/pcl_cloud.h"

namespace tera {

/// Plane fitted to the neighbours of a point.
struct LocalPlane {
  bool is_plane = false;
  Vec3 mean_m = Vec3::Zero(), normal = Vec3::UnitZ();
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitY();  ///< axes in the plane
  double spread_along_m2 = 0, spread_across_m2 = 0;    ///< variances of the points along these axes
  double noise_m2 = 0;  ///< variance of the points normal to the plane
  double radius_m = 0;  ///< distance of the farthest neighbour
  std::vector<int> points;

  /// Variances of the normal's tilt towards `along` and `across`, caused by noise of the points.
  double tilt_along_rad2() const { return TiltBy(spread_along_m2); }
  double tilt_across_rad2() const { return TiltBy(spread_across_m2); }
  /// Change of the plane's height at `at_m` per change of the height of the point at `point_m`.
  double Influence(const Vec3& at_m, const Vec3& point_m) const;

 private:
  double TiltBy(double spread_m2) const {
    return noise_m2 / (static_cast<double>(points.size()) * spread_m2);
  }
};

/// Points of a cloud, each with the plane through its neighbours.
class PlaneMap {
 public:
  explicit PlaneMap(std::vector<Vec3> p_m);

  /// Index of the point nearest to `p_m`; -1 if none is within `gate_m`.
  int Nearest(const Vec3& p_m, double gate_m) const;
  const LocalPlane& plane(int point) const { return planes_[static_cast<std::size_t>(point)]; }
  const std::vector<Vec3>& points_m() const { return p_m_; }

 private:
  std::vector<Vec3> p_m_;
  PclCloud::Ptr cloud_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
  std::vector<LocalPlane> planes_;
};

}  // namespace tera
