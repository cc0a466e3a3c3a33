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

/// Split of a recording's scans or pictures by blocks of time.
///
/// Model   blocks of a second, or of a fortieth of the recording if that is longer. Each ten in a
///         row have four of TRAIN, three of SELECT and three of FINAL, in random order.
/// Omits   pose noise that lasts longer than a block, which counts as error.
struct ScanSplit {
  std::vector<std::size_t> block;  ///< of each scan; empty blocks are not counted
  std::vector<Part> part;          ///< of each scan
  std::size_t blocks = 0;
};

/// `t_ns` of the scans, ascending.
ScanSplit SplitScans(const std::vector<TimeNs>& t_ns, const Stream& stream);

/// Fewest blocks with scans for judging a sensor: three of them are FINAL.
inline constexpr std::size_t kFewestBlocks = 10;

/// Elements of a small change of a calibration: p_BT in B, a rotation vector of T in B's axes in
/// radians, and the three scalar parameters.
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
/// One row for each element, one column for each free parameter.
using CalibrationJacobian = Eigen::Matrix<double, kCalibrationElements, Eigen::Dynamic>;

/// Derivatives of the calibration by the terms' free parameters, in their order, by central
/// differences. Each term replaces the scenario's effect of the same mechanism in `present`. `X_BS`
/// is the documented mount.
CalibrationJacobian JacobianOf(const Pose& X_BS, const Effects& present, const Structure& terms);

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

/// The compared kind of data of a sensor.
enum class ComparedBy { kRanges, kPictures };

/// Candidate effects on a whole perception sensor: `extrinsic` and `clock_offset` of the sensors'
/// table (sensors/sensor_mechanisms.h); for ranges also `range_bias` and `scale`, if the kind has
/// them. Parameter ranges are those of the table, and all parameters are free.
///
/// Model   priors by unit: 0.3 m, 5 deg, 5 per cent, 1 s. Clock offsets are searched up to 3 s, and
///         around the 18 s between GPS time and UTC, in either direction.
/// Omits   errors of single beams or pixels, drift, rolling shutter.
std::vector<Candidate> CandidatesOf(EffectTarget kind, ComparedBy compared,
                                    const std::string& sensor, const Effects& present);

/// One sensor's recording and simulation, as input to the search for effects on the sensor. It
/// corresponds to ReplayBlock (search/fit/replay_block.h) of channels on one grid. Points are
/// associated anew with simulated surfaces or edges whenever the sensor moves. The number of judged
/// points and their associations therefore depend on the terms, and each point has its own noise.
///
/// Frames  B link, S sensor as documented.
struct RegistrationBlock {
  Pose X_BS = Pose::Identity();
  Effects present;                    ///< of the sensor, as the scenario has them
  std::vector<Candidate> candidates;  ///< possible effects on it
  /// Residuals of points under a calibration. Level 0 has full resolution. Each further level, up
  /// to `coarsest`, covers twice the distance with less detail.
  std::function<std::vector<PointResidual>(const std::vector<ScanPoints>& points,
                                           const SensorCalibration& calibration, int level)>
      residuals;
  int coarsest = 0;

  /// The calibration in which each term replaces the scenario's effect of its mechanism.
  SensorCalibration Under(const Structure& terms) const {
    return CalibrationUnder(X_BS, WithTerms(present, terms));
  }
};

}  // namespace tera
