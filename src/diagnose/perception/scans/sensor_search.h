#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/perception/scans/scan_split.h"
#include "diagnose/perception/scans/sensor_fit.h"
#include "diagnose/search/block/block_diagnosis.h"

namespace tera {

/// A mechanism that may act on a whole sensor, and its numbers in effects.yaml.
struct SensorMechanism {
  struct Number {
    SensorNumbers::Index index;
    std::string_view name, unit;
    double factor;  ///< from SI
  };
  std::string_view id;
  std::vector<Number> numbers;
};

SensorMechanism OfMount();  ///< `extrinsic`
SensorMechanism OfClock();  ///< `clock_offset`

/// Both, `range_bias` and `scale`.
std::vector<SensorMechanism> MechanismsOf(const RangeSource& source);

/// What a search looks at: the points of one part or of several, and when they were.
struct SearchedPoints {
  std::vector<ScanPoints> train, select, seen, final;  ///< seen: both of the first
  std::vector<std::size_t> block;                      ///< of each scan
};

SearchedPoints PointsToSearch(
    const ScanSplit& split,
    const std::function<std::vector<ScanPoints>(const std::vector<Part>& parts)>& points);
SearchedPoints PointsToSearch(const RangeSource& source, const ScanSplit& split,
                              const std::vector<std::vector<bool>>& left_out);

/// A mechanism that acts on a whole sensor and so on all its points.
struct SensorFinding {
  std::string_view mechanism;                 ///< as in effects.yaml
  std::vector<ParameterEstimate> parameters;  ///< in the units of effects.yaml
  std::vector<double> present;                ///< of each parameter, where the scenario has it
  std::vector<std::string_view> rivals;       ///< that do as well, the one found first
  double p_chosen = 1, p_confirmed = 1;
  /// Of the 95 % of FINAL's points that lie nearest to the simulation: without it, with it.
  double rmse_before = 0, rmse_after = 0;
};

/// How small a mechanism may be and still change the distances to the surfaces enough.
struct SensorDetectability {
  std::string_view mechanism, parameter, unit;
  std::optional<double> smallest;  ///< none: the scans do not tell
};

struct SensorSearch {
  SensorNumbers numbers;  ///< with all that was found
  double scale = 1;       ///< of the noise over its model
  double noise_rmse = 0;
  std::vector<SensorFinding> findings;
  std::vector<SensorFinding> unconfirmed;
  std::vector<SensorDetectability> detectability;
};

/// Which of some mechanisms act on a sensor.
///
/// Model   noise from what a fit of all leaves of TRAIN. Forward from nothing, each fitted to
///         TRAIN (sensor_fit.h), the one that gains most on SELECT first; one stays if its gain
///         there is steady over blocks of time (steady_gain.h, one per cent over the number of
///         mechanisms) and makes the error at least 2 % smaller; then each that the others can do
///         without goes. A mechanism of fewer numbers is preferred where it is not steadily worse,
///         and what does as well in its place is its rival. On FINAL, which nothing was fitted to,
///         each must gain at five per cent again.
/// Omits   errors of single beams; drift over time.
SensorSearch SearchSensor(const SensorComparison& sensor,
                          const std::vector<SensorMechanism>& mechanisms,
                          const SearchedPoints& points);

/// The same of ranges. `left_out` names points that something else explains, one list a scan; may
/// be empty.
SensorSearch SearchSensor(const RangeSource& source, const ScanSplit& split,
                          const std::vector<std::vector<bool>>& left_out);

/// Root mean square of the 95 % nearest.
double TrimmedRmse(const std::vector<PointResidual>& residuals);

}  // namespace tera
