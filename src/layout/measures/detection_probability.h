#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Probability that at least `least` points lie on a target if `expected` points lie on it on
/// average.
///
/// Model   Poisson: P(N >= k) = P(k, m), the regularised lower incomplete gamma function; 0 if
///         `expected` is 0.
double ProbabilityOfAtLeast(int least, double expected);

/// Probability that a cluster detector finds a person by the lidar points on the body, for each
/// place around the machine.
///
/// Frames  sectors as in PolarMap. Distances run from the machine's hull to the person's centre.
/// Model   the detector groups non-ground points into Euclidean clusters. It accepts each cluster
///         of at least `least` points as a person. One scan of each lidar contributes to one common
///         point cloud.
///         A beam that hits the unoccluded person returns if the distance is within the lidar's
///         range for the person's reflectance and incidence (Lidar). Beyond that range no beam
///         returns.
///         The position of the beam pattern relative to the person is random. The number of points
///         is Poisson; its mean follows from the body's solid angle. Lidars are independent, so
///         their sum is Poisson too.
/// Omits   the row and column structure of the beams, which reduces the variance below Poisson; the
///         side that the person turns to the lidar; objects close enough to join the cluster; body
///         parts near the ground, which count as ground; false detections; a classifier of
///         clusters; consecutive scans; cameras.
/// Source  the threshold of 5 points is cluster_size_min in the published code
///         (yzrobot/online_learning) of Yan, Duckett and Bellotto, Online learning for human
///         classification in 3D LiDAR-based tracking (IROS 2017). Their detector uses Euclidean
///         clusters of the Point Cloud Library.
class DetectionProbability {
 public:
  /// Tests `steps` distances: 1 m, 2 m and so on.
  DetectionProbability(const std::string& posture, int least, int steps);

  /// Adds a moment. `expected` is the mean number of points of all lidars on the person at each
  /// place.
  void Add(const std::vector<PersonPlace>& places, const std::vector<double>& expected);

  /// "person/POSTURE/probability_within_12m" is the mean over all places within 12 m.
  /// "..._within_12m_ahead", "_left", "_behind" and "_right" are the means over a quarter. Each is
  /// 0 without a place.
  std::vector<Figure> Figures() const;
  /// "person/POSTURE/probability" is the mean over the moments at each place;
  /// "..._probability_worst" is the minimum. Ring r is r + 1 m from the hull.
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
