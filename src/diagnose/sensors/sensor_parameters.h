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

/// One number of a mechanism of one target, in SI units.
struct SensorParameter {
  std::string name, unit;  ///< as the mechanism has them, "yaw_deg", "deg"
  double si_per_unit = 1;
  double documented = 0, tolerance = 0;
  double free_sigma = 0;  ///< of its prior where it is free
  double wander = 0;      ///< 1 sigma of the difference between segments
  double lower = 0, upper = 0;
  double least = -std::numeric_limits<double>::infinity();  ///< of any physical value
  double taken = 0;  ///< of its tolerance, by numbers with the same effect
  /// The number, in `unit`, that a share of one stands for. Only shares have it.
  struct Told {
    double value = 0, sigma = 0, documented = 0;
  };
  std::optional<Told> of_share;
};

/// A mechanism, one of the table of all, and its target. Numbers of the motion's own model have
/// none.
struct TargetMechanism {
  std::string target;
  const Mechanism* mechanism = nullptr;

  bool operator==(const TargetMechanism&) const = default;
  /// "imu_boom/bias", for reports.
  std::string Name() const { return target + "/" + std::string(mechanism->id); }
};

/// A mechanism of one target, with all its numbers, which is named, or not, as a whole.
struct ParameterGroup : TargetMechanism {
  int first = 0, count = 0;  ///< its parameters
  bool may_be_named = true;
};

/// The numbers of all sensors that mechanisms can change.
struct ParameterTable {
  Tolerances stated;  ///< by the owner; of other numbers the defaults hold
  std::vector<SensorParameter> parameters;
  std::vector<ParameterGroup> groups;

  /// The tolerance of a number, in its own unit.
  double HalfWidthOf(const std::string& target, const std::string& mechanism,
                     const std::string& parameter) const;
  /// The parameters' prior where some groups are free within the range of their mechanism. Others
  /// are normal with half their tolerance as sigma, and within it.
  ParameterPrior PriorWith(const std::vector<int>& free_groups) const;
  /// A wide prior without bounds, under which nearly all that can be fitted is.
  ParameterPrior FlexiblePrior() const;
  Eigen::VectorXd Wander() const;
  /// The places of all delays.
  std::vector<int> Delays() const;
  /// Lets only mechanisms of a library be named, with numbers in its ranges.
  void LimitTo(const CandidateLibrary& library);
};

/// By how much the scenario has a sensor's stamps late: its clock, its latency and its filter.
double DocumentedDelay_s(const Effects& effects);

/// Adds the parameters of one sensor and sets their places in its channel. It is off its place by
/// no more than the extent of the part that it is bolted to.
void AddImuParameters(const SensorDescription& unit, const Vec3& part_m, ParameterTable* table,
                      UnitChannel* channel);
/// The time constant of a unit's low pass, which its documented delay no longer stands for.
void AddLowPass(const SensorDescription& unit, ParameterTable* table, UnitChannel* channel);
/// The range of a unit's rates and forces by its effects; infinite where it is not documented.
std::array<double, 2> DocumentedLimits(const SensorDescription& unit);
/// The shares of a unit's rates and forces beyond its channel's limits that do not show. `sigma` is
/// that of the limits, SI. Documented limits clip all, and are not named.
void AddClipping(const SensorDescription& unit, const std::array<double, 2>& sigma,
                 ParameterTable* table, UnitChannel* channel);
void AddReceiverParameters(const SensorDescription& receiver, const Vec3& part_m, double segment_s,
                           ParameterTable* table, ReceiverChannel* channel);
/// The numbers of a part's reflection beside a receiver that has such a part.
void AddReflectionParameters(const SensorDescription& receiver, ParameterTable* table,
                             ReceiverChannel* channel);
/// The yaw of two antennas of one link, which belongs to the first of them. Its tolerance is that
/// of the whole heading, less `by_places_rad`, by which the antennas' own places may turn it.
int AddPairYaw(const SensorDescription& receiver, double by_places_rad, ParameterTable* table);
/// One axis of a set of encoders. `effects` are those of the axis, `target` its name
/// "encoders/boom", `swing` the standard deviation of its positions, rad or m. Its scale cannot be
/// named if even the widest scale changes positions by less than the zero's tolerance. A joint at
/// rest does not distinguish the two.
void AddAxisParameters(const std::string& target, const Effects& effects, bool slides, double swing,
                       ParameterTable* table, AxisChannel* channel);
/// The delay of a set of encoders, for all its axes.
int AddEncoderDelay(const std::string& target, const Effects& effects, ParameterTable* table);
/// The gain of the acceleration of a joint or of the base's yaw, which is never named; returns its
/// place.
///
/// Model   every inertial unit behind a joint feels the same gain, so that a scale common to all of
///         them is none of theirs. A spline has too little of accelerations shorter than its knots.
///         A recorder or simulator with discrete steps has accelerations that differ from its
///         rates'.
int AddAccelerationGain(const std::string& number, ParameterTable* table);
/// By how much the known ground is too high, which is never named; returns its place.
int AddGroundHeight(ParameterTable* table);
/// Parameters of recorded poses. Poses of a simulation are true, and at most late.
void AddPoseParameters(bool were_measured, ParameterTable* table, MapChannel* channel);

}  // namespace tera
