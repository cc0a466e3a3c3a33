#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/study/study.h"

namespace tera {

/// Average precision of a detector that has `samples` points or pixels of its target.
///
/// Model   a ln(m) + b, held between 0.001 and 0.999, since outside the standard deviation below is
///         no positive number; without a sample 0.001. With the defaults of InformationStudy a
///         lidar is at the upper bound from 10 points on.
double PrecisionOf(const PrecisionFit& fit, double samples);
/// Standard deviation of what such a detector says: 1 / AP - 1.
double SigmaOf(double precision);
/// Of several sensors together: sigma^-2 = sum of sigma_i^-2.
double FusedSigma(const std::vector<double>& sigmas);
/// Entropy of a position in the plane that is normally distributed so: 2 ln sigma + 1 + ln(2 pi).
double PlanarEntropy(double sigma);

/// How uncertain it stays where people around the machine are: perception entropy.
///
/// Frames  H as in PolarGrid.
/// Model   a person, the study's first posture, at places all around, every second metre from the
///         machine's sides to the study's farthest, one place counting like another; the points or
///         pixels of each viewer on her; the entropy of all that have any, fused. Whoever has none
///         adds nothing; she whom none sees has the entropy of the lowest precision.
/// Omits   against the paper: adding up the samples of sensors of one kind before they are fused,
///         and targets of several kinds with weights. The default coefficients are those of
///         automated driving (InformationStudy).
/// Source  Ma, Liu and Li, Perception Entropy: A Metric for Multiple Sensors Configuration
///         Evaluation and Design, arXiv 2104.06615: AP ~ a ln m + b, sigma = 1 / AP - 1,
///         H = 2 ln sigma + 1 + ln 2 pi, sigma_f^-2 = sum sigma_i^-2.
class PerceptionEntropy {
 public:
  PerceptionEntropy(const PersonStudy& person, const InformationStudy& information,
                    double reflectance);

  /// `hull_m` is HullRadii_m of the directions that are tried.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  /// "information/perception_entropy", the mean over the places, in nats.
  std::vector<Figure> Figures() const;

 private:
  PersonStudy person_;
  InformationStudy information_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  std::vector<double> mean_nat_, error_nat_;  ///< over the places, of each moment
};

}  // namespace tera
