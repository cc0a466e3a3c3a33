#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/perception/registration/calibration_jacobian.h"
#include "resimulate/simulated_return.h"

namespace tera {

/// Residual of one measured point against the simulation, under one calibration: in metres, or for
/// pictures in pixels.
struct PointResidual {
  std::size_t scan = 0;
  Surface surface = Surface::kUnknown;  ///< surface that the point is associated with
  double distance = 0;  ///< from the simulated surface or edge to the point, along its normal,
                        ///< positive behind it
  double sigma = 1;     ///< of `distance`, by the model of noise
  bool out_of_picture = false;  ///< beyond the border: not judged, and no evidence either way
  CalibrationVector by_calibration = CalibrationVector::Zero();  ///< derivatives of `distance`

  bool is_judged() const { return IsComparable(surface); }
};

/// Points of one scan, by index.
struct ScanPoints {
  std::size_t scan = 0;
  std::vector<std::size_t> points;
};

/// Log-density of Student's t of 4 degrees of freedom at a distance over its standard deviation,
/// minus that at 0; constant beyond 30 standard deviations.
double LogDensityAt(double distance_over_sigma);

/// Log-likelihood of a point under noise of `scale` times its sigma, minus that of a distance of 0.
/// It is bounded: a ray to another object costs 13, and so does an unjudged point.
double LogLikelihoodOf(const PointResidual& residual, double scale);
double LogLikelihoodOf(const std::vector<PointResidual>& residuals, double scale);

/// Robust standard deviation of distances over their sigma, for judged points.
double ScaleOf(const std::vector<PointResidual>& residuals);

/// Root mean square of the smallest 95 % of the judged distances; the rest count as outliers.
double TrimmedRmse(const std::vector<PointResidual>& residuals);

/// Weight of a point in least squares, of Student's t of the same degrees of freedom.
double RobustWeightOf(const PointResidual& residual, double scale);

}  // namespace tera
