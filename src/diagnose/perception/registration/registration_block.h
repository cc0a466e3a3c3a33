#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/search/fit/replay_block.h"
#include "diagnose/statistics/series/manoeuvres.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"

namespace tera {

/// Assigns scans or pictures to the parts TRAIN, SELECT and FINAL (docs/guide/glossary.md), by
/// blocks of time.
///
/// Model   A block lasts one second, or a fortieth of the recording if that is longer. Ten
///         consecutive blocks form a round: four for TRAIN, three for SELECT and three for FINAL,
///         in random order.
/// Omits   Pose noise that lasts longer than a block, which counts as a sensor error.
struct ScanSplit {
  std::vector<std::size_t> block;  ///< block of each scan; blocks without scans are not counted
  std::vector<Part> part;          ///< part of each scan
  std::size_t blocks = 0;
};

/// `t_ns`: times of the scans, ascending.
ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream);

/// A sensor with fewer blocks is not judged. Ten blocks contain three for FINAL.
inline constexpr std::size_t kFewestBlocks = 10;

/// Elements of a small change of a calibration: the mount's position p_BT in B, in metres; the
/// mount's rotation vector in the axes of B, in radians; range bias, range factor and clock offset.
enum CalibrationElement {
  kShiftOfMount = 0,
  kTurnOfMount = 3,
  kRangeBias = 6,
  kRangeFactor = 7,
  kClockOffset = 8,
  kCalibrationElements = 9
};
using CalibrationVector = Eigen::Matrix<double, kCalibrationElements, 1>;
using CalibrationMatrix = Eigen::Matrix<double, kCalibrationElements, kCalibrationElements>;
/// Rows are elements of the calibration, columns are free parameters.
using CalibrationJacobian = Eigen::Matrix<double, kCalibrationElements, Eigen::Dynamic>;

/// Derivatives of the calibration with respect to the free parameters of `terms`, by central
/// differences. A term is a candidate mechanism with values (search/fit/replay_block.h). A term
/// replaces the effect of its mechanism in `present`. `X_BS` is the documented mount.
CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms);

/// Residual of one measured point against the simulation under a calibration. Unit: metres for
/// ranges, pixels for pictures.
struct PointResidual {
  std::size_t scan = 0;
  Surface surface = Surface::kUnknown;  ///< simulated surface to which the point is associated
  double distance = 0;  ///< along the surface normal, positive behind the simulated surface or edge
  double sigma = 1;     ///< standard deviation of `distance` in the noise model
  /// Beyond the picture's border: not judged, and ignored in gains of likelihood.
  bool out_of_picture = false;
  CalibrationVector by_calibration = CalibrationVector::Zero();  ///< derivatives of `distance`

  bool is_judged() const { return IsComparable(surface); }
};

/// Points of one scan, by index.
struct ScanPoints {
  std::size_t scan = 0;
  std::vector<std::size_t> points;
};

/// Log-density of Student's t with 4 degrees of freedom, relative to its value at 0. The argument
/// is a distance in standard deviations. The function is constant beyond 30.
double LogDensityAt(double distance_over_sigma);

/// Log-likelihood of a residual relative to a distance of 0. The noise is `scale` times the
/// residual's sigma. The loss is at most 13.6 (LogDensityAt at 30); unjudged points get this loss.
double LogLikelihoodOf(const PointResidual& residual, double scale);
double LogLikelihoodOf(const std::vector<PointResidual>& residuals, double scale);

/// Robust ratio of actual noise to modelled noise: the normalised median of |distance| / sigma over
/// judged points.
double ScaleOf(const std::vector<PointResidual>& residuals);

/// Root mean square of the smallest 95 % of judged distances. The rest count as outliers.
double TrimmedRmse(const std::vector<PointResidual>& residuals);

/// Weight of a point in iteratively reweighted least squares, for the same Student's t.
double RobustWeightOf(const PointResidual& residual, double scale);

/// Kind of data by which a sensor is compared.
enum class ComparedBy { kRanges, kPictures };

/// Candidate effects on a lidar or camera: `extrinsic` and `clock_offset`. For ranges, `range_bias`
/// and `scale` are added if the kind of sensor has them. Mechanisms and parameter ranges are from
/// sensors/sensor_mechanisms.h; all parameters are free.
///
/// Model   Prior standard deviations by unit: 0.3 m, 5 deg, 5 per cent, 1 s. Starting values of the
///         clock offset reach 3 s in either direction, and include +-18 s, the difference between
///         GPS time and UTC.
/// Omits   Errors of single beams or pixels, drift, rolling shutter.
std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present);

/// Input to the search for effects on one sensor. ReplayBlock (search/fit/replay_block.h) is the
/// corresponding input for channels on a time grid. Each new calibration re-associates points with
/// simulated surfaces or edges. Therefore the number of judged points depends on the terms. Each
/// point has its own noise.
///
/// Frames  B link, S sensor as documented.
struct RegistrationBlock {
  Pose X_BS = Pose::Identity();
  Effects present;  ///< effects on the sensor in the scenario
  std::vector<Candidate> candidates;
  /// Residuals of points under a calibration. Level 0 has full resolution. Each next level, up to
  /// `coarsest`, doubles the range of convergence and has less detail.
  std::function<std::vector<PointResidual>(const std::vector<ScanPoints>& points,
                                           const SensorCalibration& calibration, int level)>
      residuals;
  int coarsest = 0;

  /// The calibration with `terms`. A term replaces the scenario's effect of its mechanism.
  SensorCalibration Under(const Structure& terms) const {
    return CalibrationUnder(X_BS, WithTerms(present, terms));
  }
};

}  // namespace tera
