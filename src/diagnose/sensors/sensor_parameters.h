#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/types/tolerance.h"
#include "diagnose/candidates/candidate_library.h"
#include "diagnose/motion/motion_estimate.h"
#include "sensors/sensor.h"

namespace tera {

/// One parameter of a mechanism of one target, in SI units.
struct SensorParameter {
  std::string name, unit;  ///< the mechanism's: "yaw_deg", "deg"
  double si_per_unit = 1;
  double documented = 0, tolerance = 0;
  double free_sigma = 0;  ///< prior deviation where its group is free
  double wander = 0;      ///< 1 sigma of its deviation from segment to segment
  double lower = 0, upper = 0;
  double least = -std::numeric_limits<double>::infinity();  ///< smallest physical value
  double taken = 0;  ///< part of the tolerance that goes to parameters with the same effect
  /// For a share: the mechanism's number, in `unit`, that a share of 1 means.
  struct Told {
    double value = 0, sigma = 0, documented = 0;
  };
  std::optional<Told> of_share;
};

/// A mechanism of the table and its target. `mechanism` is null for parameters of the motion model
/// itself.
struct TargetMechanism {
  std::string target;
  const Mechanism* mechanism = nullptr;

  bool operator==(const TargetMechanism&) const = default;
  /// For reports: "imu_boom/bias".
  std::string Name() const { return target + "/" + std::string(mechanism->id); }
};

/// All parameters of a mechanism of one target. They are named together.
struct ParameterGroup : TargetMechanism {
  int first = 0, count = 0;  ///< range of its parameters
  bool may_be_named = true;
};

/// All parameters of the sensors.
struct ParameterTable {
  Tolerances stated;  ///< tolerances that the owner states; otherwise the defaults hold
  std::vector<SensorParameter> parameters;
  std::vector<ParameterGroup> groups;

  /// The tolerance of a number, in the mechanism's unit.
  double HalfWidthOf(const std::string& target, const std::string& mechanism,
                     const std::string& parameter) const;
  /// The prior with some groups free within the range of their mechanism. The others are normal
  /// about the documented value with half their tolerance as sigma, truncated to the tolerance.
  ParameterPrior PriorWith(const std::vector<int>& free_groups) const;
  /// A wide prior without bounds. Its sigma is the tolerance, for delays ten times the tolerance.
  ParameterPrior FlexiblePrior() const;
  Eigen::VectorXd Wander() const;
  /// Indices of all delays.
  std::vector<int> Delays() const;
  /// Restricts naming to the mechanisms of a library, with numbers within its ranges.
  void LimitTo(const CandidateLibrary& library);
};

/// Documented delay of a sensor's stamps: clock offset plus latency plus filter.
double DocumentedDelay_s(const Effects& effects);

/// Adds the parameters of one unit and sets their indices in its channel. `part_m`, the extent of
/// its link, bounds the shift of the unit.
void AddImuParameters(const SensorDescription& unit, const Vec3& part_m, ParameterTable* table,
                      UnitChannel* channel);
/// Adds the time constant of a unit's low pass. The documented delay of the unit then excludes it.
void AddLowPass(const SensorDescription& unit, ParameterTable* table, UnitChannel* channel);
/// Documented range of turn rates (rad/s) and specific forces (m/s^2); infinite if it is not
/// documented.
std::array<double, 2> DocumentedLimits(const SensorDescription& unit);
/// Adds the shares of rates and forces beyond the channel's limits that the unit clips. `sigma` is
/// the standard deviation of the limits in SI units. Documented limits clip everything and are not
/// named.
void AddClipping(const SensorDescription& unit, const std::array<double, 2>& sigma,
                 ParameterTable* table, UnitChannel* channel);
void AddReceiverParameters(const SensorDescription& receiver, const Vec3& part_m, double segment_s,
                           ParameterTable* table, ReceiverChannel* channel);
/// Adds the linear numbers of the reflection from the part next to a receiver (RaisedPart).
void AddReflectionParameters(const SensorDescription& receiver, ParameterTable* table,
                             ReceiverChannel* channel);
/// Adds the yaw of two antennas on one link, as a parameter of the first receiver. Its tolerance is
/// the tolerance of the heading minus `by_places_rad`, the turn that the tolerances of the antenna
/// positions allow.
int AddPairYaw(const SensorDescription& receiver, double by_places_rad, ParameterTable* table);
/// Adds the parameters of one encoder axis with its `effects`. `target` is for example
/// "encoders/boom"; `swing` is the standard deviation of positions, in rad or m. The scale cannot
/// be named if even its widest value shifts positions by less than the tolerance of the zero: a
/// joint at rest does not distinguish the two.
void AddAxisParameters(const std::string& target, const Effects& effects, bool slides, double swing,
                       ParameterTable* table, AxisChannel* channel);
/// Adds the delay that all axes of a set of encoders share.
int AddEncoderDelay(const std::string& target, const Effects& effects, ParameterTable* table);
/// Adds the acceleration gain of a joint or of the base's yaw, which is never named. Returns its
/// index.
///
/// Model   every inertial unit behind a joint sees the same gain. A scale error that all of them
///         share is therefore not attributed to a unit. Such an error has two causes. A spline
///         smooths accelerations shorter than its knots. A recorder or simulator with discrete
///         steps has accelerations that differ from the derivative of its rates.
int AddAccelerationGain(const std::string& number, ParameterTable* table);
/// Adds the height by which the known ground is too high, which is never named. Returns its index.
int AddGroundHeight(ParameterTable* table);
/// Adds the parameters of recorded poses. Simulated poses are exact apart from a delay.
void AddPoseParameters(bool were_measured, ParameterTable* table, MapChannel* channel);

}  // namespace tera
