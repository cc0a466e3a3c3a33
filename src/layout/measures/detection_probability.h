#pragma once

#include <string>
#include <vector>

#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/measures/polar_map.h"

namespace tera {

/// Probability that at least `least` points lie on a target on which `expected` lie on average.
///
/// Model   their number is Poisson's: P(N >= k) = P(k, m), the regularised lower incomplete gamma
///         function; 0 where none is expected.
double ProbabilityOfAtLeast(int least, double expected);

/// The probability with which a detector of clusters finds a person by the points that the lidars
/// of a layout have on her, at each place around the machine.
///
/// Frames  sectors as in PolarMap; distances are from the hull of the machine to her middle.
/// Model   the detector gathers what does not belong to the ground into Euclidean clusters and
///         takes one of `least` points or more for somebody. Every beam that meets her where
///         nothing hides her returns within the lidar's reach for her reflectance at that
///         incidence, and never beyond it (Lidar). The points of one scan of each lidar lie in one
///         cloud. Where on her the rows and columns of beams fall is chance: their number is
///         Poisson's about what is expected of the solid angle, and independent of one lidar to
///         the next, so that the sum is Poisson's too.
/// Omits   that beams stand in rows and columns, whose number on her varies less than Poisson's;
///         to which side she turns; what stands so near to her that both are one cluster; her
///         parts near the ground, which go with it; persons seen where nobody is; a classifier of
///         clusters; that scans follow each other. Cameras add nothing.
/// Source  5 points and more are what the detector of Yan, Duckett and Bellotto, Online learning
///         for human classification in 3D LiDAR-based tracking (IROS 2017), takes for a cluster
///         (cluster_size_min of its published code, yzrobot/online_learning), by Euclidean
///         clusters of the Point Cloud Library.
class DetectionProbability {
 public:
  /// `steps` distances are tried, every metre from 1 m on.
  DetectionProbability(const std::string& posture, int least, int steps);

  /// `expected` points of all lidars together lie on her at each place of this moment.
  void Add(const std::vector<PersonPlace>& places, const std::vector<double>& expected);

  /// "person/POSTURE/probability_within_12m", the mean over the places, and
  /// "..._within_12m_ahead", "_left", "_behind", "_right" over those of a quarter; 0 where there is
  /// no place.
  std::vector<Figure> Figures() const;
  /// "person/POSTURE/probability", the mean over the moments of each place, and
  /// "..._probability_worst", the least. Ring r is r + 1 m from the hull.
  std::vector<PolarMap> Maps() const;

 private:
  struct Share {
    std::vector<double> mean, error;  ///< over the places, of each moment
  };

  std::string posture_;
  int least_, steps_;
  std::vector<double> sum_, lowest_, moments_;  ///< of each place, by sector * steps_ + step
  Share all_;
  std::vector<Share> quarters_;  ///< as kQuarters
};

}  // namespace tera
