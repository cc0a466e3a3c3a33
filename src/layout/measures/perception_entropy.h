#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/study/study.h"

namespace tera {

/// Average precision of a detector that has `samples` points or pixels of its target.
///
/// Model   a ln(m) + b, clamped to 0.001 to 0.999 so that the standard deviation stays positive;
///         0.001 without a sample. With the defaults of InformationStudy a lidar reaches the upper
///         bound at 10 points.
double PrecisionOf(const PrecisionFit& fit, double samples);
/// Standard deviation of such a detector: 1 / AP - 1.
double SigmaOf(double precision);
/// Fused standard deviation of several sensors: sigma^-2 = sum of sigma_i^-2.
double FusedSigma(const std::vector<double>& sigmas);
/// Entropy of a position in the plane with this deviation per axis: 2 ln sigma + 1 + ln(2 pi).
double PlanarEntropy(double sigma);

/// Perception entropy: the uncertainty about the positions of people around the machine.
///
/// Frames  H as in PolarGrid.
/// Model   a person in the study's first posture stands at places in all directions, every second
///         metre from the machine's sides to the study's largest distance. All places have equal
///         weight. Each viewer contributes the points or pixels it has of the person; the entropy
///         is that of the fused viewers. Viewers without samples add nothing. An unseen person has
///         the entropy of the lowest precision.
/// Omits   compared with the paper: summing samples of sensors of one kind before the fusion, and
///         targets of several kinds with weights. The default coefficients are those of automated
///         driving (InformationStudy).
/// Source  Ma, Liu and Li, Perception Entropy: A Metric for Multiple Sensors Configuration
///         Evaluation and Design, arXiv 2104.06615: AP ~ a ln m + b, sigma = 1 / AP - 1, H = 2 ln
///         sigma + 1 + ln 2 pi, sigma_f^-2 = sum sigma_i^-2.
class PerceptionEntropy {
 public:
  PerceptionEntropy(const PersonStudy& person, const InformationStudy& information,
                    double reflectance);

  /// `hull_m` is HullRadii_m of the tested directions.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  /// "information/perception_entropy", the mean over the places, in nats.
  std::vector<Figure> Figures() const;

 private:
  PersonStudy person_;
  InformationStudy information_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  std::vector<double> mean_nat_, error_nat_;  ///< over the places, one per moment
};

}  // namespace tera
