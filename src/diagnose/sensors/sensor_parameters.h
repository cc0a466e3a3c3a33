#pragma once

#include <string>
#include <vector>

#include "diagnose/motion/motion_estimate.h"
#include "diagnose/tolerances/sensor_tolerances.h"
#include "sensors/sensor.h"

namespace tera {

/// One number of a mechanism of one target, in SI units.
struct SensorParameter {
  std::string name, unit;  ///< as the mechanism has them, "yaw_deg", "deg"
  double si_per_unit = 1;
  double documented = 0, tolerance = 0;
  double wander = 0;  ///< 1 sigma of what differs from segment to segment
  double lower = 0, upper = 0;
};

/// A mechanism of one target, with all its numbers: what is named, or not, as a whole.
struct ParameterGroup {
  std::string target, mechanism;
  int first = 0, count = 0;  ///< its parameters
};

/// The numbers of all sensors that mechanisms can change.
struct ParameterTable {
  std::vector<SensorParameter> parameters;
  std::vector<ParameterGroup> groups;

  /// The parameters' prior where some groups are free within the range of their mechanism. Others
  /// are normal with half their tolerance as sigma, and within it.
  ParameterPrior PriorWith(const std::vector<int>& free_groups) const;
  /// A wide prior without bounds, under which nearly all that can be fitted is.
  ParameterPrior FlexiblePrior() const;
  Eigen::VectorXd Wander() const;
};

/// Adds the parameters of one sensor and sets their places in its channel.
void AddImuParameters(const SensorDescription& unit, const SensorTolerances& tolerances,
                      ParameterTable* table, UnitChannel* channel);
void AddReceiverParameters(const SensorDescription& receiver, const SensorTolerances& tolerances,
                           ParameterTable* table, ReceiverChannel* channel);
/// The yaw of two antennas of one link, which belongs to the first of them.
int AddPairYaw(const SensorDescription& receiver, const SensorTolerances& tolerances,
               ParameterTable* table);
/// `effects` are those of the axis, `target` its name: "encoders/boom". Of an axis that
/// slides the tolerance in radians counts in metres.
void AddAxisParameters(const std::string& target, const Effects& effects, bool slides,
                       const SensorTolerances& tolerances, ParameterTable* table,
                       AxisChannel* channel);
/// The delay of a set of encoders, for all its axes.
int AddEncoderDelay(const std::string& target, const Effects& effects,
                    const SensorTolerances& tolerances, ParameterTable* table);
void AddPoseParameters(const SensorTolerances& tolerances, ParameterTable* table,
                       MapChannel* channel);

}  // namespace tera
