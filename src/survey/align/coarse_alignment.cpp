#include "survey/align/coarse_alignment.h"

#include <pcl/console/print.h>
#include <pcl/exceptions.h>
#include <pcl/registration/gicp.h>

#include <algorithm>

#include "survey/points/pcl_cloud.h"

namespace tera {

std::optional<Pose> AlignByGicp(const std::vector<Vec3>& a_m, const std::vector<Vec3>& b_m,
                                double gate_m, double least_gate_m) {
  constexpr int kNeighbours = 20;  // points per covariance of GICP
  if (std::min(a_m.size(), b_m.size()) <= static_cast<std::size_t>(kNeighbours)) {
    return std::nullopt;
  }
  pcl::console::setVerbosityLevel(
      pcl::console::L_ALWAYS);  // silences PCL's messages; the caller reports failures
  constexpr int kSteps = 40;
  constexpr double kEpsilon = 1e-5;
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
  gicp.setInputTarget(ToPcl(a_m));
  gicp.setInputSource(ToPcl(b_m));
  gicp.setCorrespondenceRandomness(kNeighbours);
  gicp.setMaximumIterations(kSteps);
  gicp.setTransformationEpsilon(kEpsilon);
  gicp.setRotationEpsilon(kEpsilon);
  Eigen::Matrix4f move = Eigen::Matrix4f::Identity();
  try {
    for (double gate = gate_m;; gate = std::max(0.5 * gate, least_gate_m)) {
      gicp.setMaxCorrespondenceDistance(gate);
      PclCloud moved;
      gicp.align(moved, move);
      move = gicp.getFinalTransformation();
      if (gate <= least_gate_m) break;
    }
  } catch (const pcl::PCLException&) {
    return std::nullopt;
  }
  if (!move.allFinite()) return std::nullopt;
  Pose X;
  X.linear() = Quat(move.topLeftCorner<3, 3>().cast<double>()).normalized().toRotationMatrix();
  X.translation() = move.topRightCorner<3, 1>().cast<double>();
  return X;
}

}  // namespace tera
