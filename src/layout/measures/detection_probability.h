#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Probability that at least `least` points lie on a target with `expected` points on average.
///
/// Model   Poisson: P(N >= k) = P(k, m), the regularised lower incomplete gamma function; 0 if none
///         is expected.
double ProbabilityOfAtLeast(int least, double expected);

/// Probability that a cluster detector finds a person by the lidar points on the body, at each
/// place around the machine.
///
/// Frames  sectors as in PolarMap; distances run from the machine's hull to the person's middle.
/// Model   the detector groups non-ground points into Euclidean clusters and accepts clusters of
///         `least` points or more. A beam that meets the person without occlusion always returns
///         within the lidar's reach for the person's reflectance at that incidence, and never
///         beyond (Lidar). One scan of each lidar forms one cloud. The position of the beams' rows
///         and columns on the person is random. The number of points is Poisson about the
///         expectation of the solid angle, independent between lidars, so the sum is Poisson.
/// Omits   the row and column structure of the beams, which reduces the variance below Poisson; the
///         side that the person turns to the lidar; objects so near that they join the cluster;
///         body parts near the ground, which count as ground; false detections; a classifier of
///         clusters; consecutive scans. Cameras add nothing.
/// Source  the threshold of 5 points is cluster_size_min in the published code
///         (yzrobot/online_learning) of Yan, Duckett and Bellotto, Online learning for human
///         classification in 3D LiDAR-based tracking (IROS 2017). Their detector uses Euclidean
///         clusters of the Point Cloud Library.
class DetectionProbability {
 public:
  /// Tests `steps` distances, every metre from 1 m on.
  DetectionProbability(const std::string& posture, int least, int steps);

  /// `expected` is the number of points of all lidars together on the person at each place of this
  /// moment.
  void Add(const std::vector<PersonPlace>& places, const std::vector<double>& expected);

  /// "person/POSTURE/probability_within_12m", the mean over the places, and "..._within_12m_ahead",
  /// "_left", "_behind", "_right" over the places of a quarter; 0 without a place.
  std::vector<Figure> Figures() const;
  /// "person/POSTURE/probability", the mean over the moments at each place, and
  /// "..._probability_worst", the minimum. Ring r is r + 1 m from the hull.
  std::vector<PolarMap> Maps() const;

 private:
  struct Share {
    std::vector<double> mean, error;  ///< over the places, one per moment
  };

  std::string posture_;
  int least_, steps_;
  std::vector<double> sum_, lowest_, moments_;  ///< one per place, by sector * steps_ + step
  Share all_;
  std::vector<Share> quarters_;  ///< in the order of kQuarters
};

}  // namespace tera
