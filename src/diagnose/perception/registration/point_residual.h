#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/perception/registration/calibration_jacobian.h"
#include "resimulate/simulated_return.h"

namespace tera {

/// How far one measured point is from what is simulated, under one calibration: in metres, in
/// pictures in pixels.
struct PointResidual {
  std::size_t scan = 0;
  Surface surface = Surface::kUnknown;  ///< with which the point is associated
  double distance = 0;  ///< of the point behind the simulated surface or edge, along its normal
  double sigma = 1;     ///< of `distance`, by the model of noise
  bool out_of_picture = false;  ///< beyond its border: not judged, and no evidence either way
  CalibrationVector by_calibration = CalibrationVector::Zero();  ///< derivatives of `distance`

  bool is_judged() const { return IsComparable(surface); }
};

/// Points of one scan, by index.
struct ScanPoints {
  std::size_t scan = 0;
  std::vector<std::size_t> points;
};

/// Log-density of Student's t of 4 degrees of freedom at a distance over its standard deviation,
/// less that at 0; beyond 30 standard deviations as at 30.
double LogDensityAt(double distance_over_sigma);

/// Log-likelihood of a point under noise of `scale` times its sigma, less that of a distance of 0;
/// bounded, so that a ray that meets something else altogether costs 13, as does one of which
/// nothing can be said.
double LogLikelihoodOf(const PointResidual& residual, double scale);
double LogLikelihoodOf(const std::vector<PointResidual>& residuals, double scale);

/// Robust standard deviation of distances over their sigma, of points that are judged.
double ScaleOf(const std::vector<PointResidual>& residuals);

/// Root mean square of the nearest 95 % of the distances that are judged: the others are held to be
/// outliers.
double TrimmedRmse(const std::vector<PointResidual>& residuals);

/// Weight of a point in least squares, of Student's t of the same degrees of freedom.
double RobustWeightOf(const PointResidual& residual, double scale);

}  // namespace tera
