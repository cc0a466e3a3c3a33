#pragma once

#include <vector>

#include "layout/layout.h"
#include "layout/measures/figure.h"
#include "layout/measures/person_samples.h"
#include "layout/study/study.h"

namespace tera {

/// Average precision (AP) of a detector that has `samples` points or pixels on its target.
///
/// Model   AP = a ln(m) + b, clamped to [0.001, 0.999] so that SigmaOf stays positive and finite;
///         0.001 without a sample. With the default fit of InformationStudy, a lidar reaches 0.999
///         at 10 points.
double PrecisionOf(const PrecisionFit& fit, double samples);
/// Standard deviation of the detected position: 1 / AP - 1.
double SigmaOf(double precision);
/// Fused standard deviation of several sensors: sigma^-2 = sum of sigma_i^-2.
double FusedSigma(const std::vector<double>& sigmas);
/// Entropy of a planar position with this deviation per axis: 2 ln sigma + 1 + ln(2 pi), in nats.
double PlanarEntropy(double sigma);

/// Perception entropy: the uncertainty about the positions of people around the machine.
///
/// Frames  H as in PolarGrid.
/// Model   a person in the study's first posture stands in each direction at every second metre,
///         from the machine's hull to the study's maximum distance. All places have equal weight.
///         The entropy at a place is that of the fused viewers. Each viewer counts with its own
///         points or pixels on the person; viewers without samples add nothing. The entropy of an
///         unseen person is that of the lowest precision.
/// Omits   two parts of the paper: summing the samples of sensors of one kind before fusion, and
///         weighted targets of several kinds. The default coefficients are those of automated
///         driving (InformationStudy).
/// Source  Ma, Liu and Li, Perception Entropy: A Metric for Multiple Sensors Configuration
///         Evaluation and Design, arXiv 2104.06615: AP ~ a ln m + b, sigma = 1 / AP - 1, H = 2 ln
///         sigma + 1 + ln 2 pi, sigma_f^-2 = sum sigma_i^-2.
class PerceptionEntropy {
 public:
  PerceptionEntropy(const PersonStudy& person, const InformationStudy& information,
                    double reflectance);

  /// Adds a moment. `hull_m` is HullRadii_m of the tested directions.
  void Add(const Pose& X_WH, const std::vector<double>& hull_m, const Layout& layout,
           const Sighting& sighting, const TerrainSurface& ground);

  /// "information/perception_entropy": the mean over the places, in nats.
  std::vector<Figure> Figures() const;

 private:
  PersonStudy person_;
  InformationStudy information_;
  double reflectance_;
  std::vector<BodyPatch> patches_;
  /// Mean over the places and its sampling error, one per moment.
  std::vector<double> mean_nat_, error_nat_;
};

}  // namespace tera
