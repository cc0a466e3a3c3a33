#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "diagnose/perception/scans/range_scan.h"

namespace tera {

/// Which of a sensor's numbers are free in a fit.
using FreeNumbers = std::array<bool, SensorNumbers::kCount>;

/// What one point says of one set of numbers: in metres, of pictures in pixels.
struct PointResidual {
  std::size_t scan = 0;
  Surface surface = Surface::kUnknown;
  double beyond = 0;  ///< of the point behind the simulated surface or edge, along its normal
  double sigma = 1;   ///< of that, by the model of noise
  bool out_of_picture = false;  ///< beyond its border: not judged, and no evidence either way
  /// Derivatives of `beyond` by the numbers.
  Eigen::Matrix<double, SensorNumbers::kCount, 1> slope =
      Eigen::Matrix<double, SensorNumbers::kCount, 1>::Zero();

  bool is_judged() const {
    return surface == Surface::kGround || surface == Surface::kObstacle ||
           surface == Surface::kMachine;
  }
};

/// Points of one scan, by index.
struct ScanPoints {
  std::size_t scan = 0;
  std::vector<std::size_t> points;
};

/// How the recording of a sensor differs from its simulation.
struct SensorComparison {
  SensorNumbers present;  ///< as the scenario has them
  SensorNumbers start;    ///< from which fits begin
  /// Residuals of points under numbers: `coarse` 0 in full, each more sees differences twice as
  /// large, but less of them.
  std::function<std::vector<PointResidual>(const std::vector<ScanPoints>& points,
                                           const SensorNumbers& numbers, int coarse)>
      residuals;
  int coarsest = 0;
};

/// Numbers fitted to scans, the others as they are at the start.
struct SensorFit {
  SensorNumbers numbers;
  /// Posterior over prior standard deviation of each free number: near 1 the scans say nothing.
  std::array<double, SensorNumbers::kCount> undetermined = {};
  std::array<double, SensorNumbers::kCount> sigma = {};
};

/// Fits by Gauss and Newton, the residuals taken anew in each of its rounds, coarse ones first: in
/// the coarsest angles and clock alone, since a place is soon lost among the angles.
///
/// Model   Student-t noise of 4 degrees of freedom and `scale` times sigma_m, approached from a
///         wide scale so that errors larger than noise are followed too; normal priors about the
///         start (0.3 m, 5 deg, 0.3 m, 5 %, 1 s) hold what the scans do not tell. Standard
///         deviations are the larger of two: of independent points, and of the scatter of the
///         scores of scans.
/// Source  Chen and Medioni 1992 (distance to planes); Lange, Little, Taylor 1989 (Student-t).
SensorFit FitSensor(const SensorComparison& sensor, const std::vector<ScanPoints>& points,
                    const FreeNumbers& is_free, const SensorNumbers& start, double scale);

/// Log-likelihood of a point, less that of a distance of 0; bounded, so that a ray that meets
/// something else altogether costs 13.
double LogLikelihoodOf(const PointResidual& residual, double scale);
double LogDensityAt(double distance_over_sigma);

/// Robust standard deviation of distances over their sigma, of points that are judged.
double ScaleOf(const std::vector<PointResidual>& residuals);

}  // namespace tera
