#include "diagnose/sensors/sensor_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/units.h"
#include "diagnose/blocks/measured_poses.h"
#include "diagnose/sensors/reflection.h"
#include "diagnose/tolerances/default_tolerances.h"
#include "sensors/imu/imu_slots.h"
#include "sensors/sensor_mechanisms.h"
#include "sensors/slots/effect_numbers.h"

namespace tera {
namespace {

constexpr double kPriorShare = 0.5;   ///< prior sigma over tolerance
constexpr double kFlexibleShare = 1;  ///< sigma of the flexible prior over tolerance
/// Further factor for delays in the flexible prior: far from the true delay their effect is not
/// linear.
constexpr double kFlexibleDelays = 10;
constexpr double kFreeShare = 100;  ///< prior sigma of a free group over the default tolerance
/// Smallest tolerance over the default: numbers stated as exact keep some uncertainty.
constexpr double kLeastShare = 0.01;
/// 1 sigma between segments over the tolerance: of biases, and of all other parameters. The latter
/// stands for effects that the models omit.
constexpr double kBiasWander = 0.25, kWander = 0.06;
constexpr double kMostDelay_s = 3;
/// Tolerance of an acceleration gain. At the beginning of a step dt, a joint with time constant T
/// accelerates 1 + dt / 2T times the step's mean; 0.1 holds for T = 5 dt.
constexpr double kAccelerationGain = 0.1;
/// Poses and the ground borrow the numbers of these mechanisms.
constexpr EffectTarget kImu = EffectTarget::kImu, kGnss = EffectTarget::kGnss;
/// A clipping unit loses at least this share of a measurement beyond its range.
constexpr double kClippedShare = 0.5;
/// Stands for clock offset, latency and filter together.
constexpr const char* kDelay = "clock_offset";
constexpr const char* kLowPass = "filter_delay";

double UsualHalfWidth(const std::string& target, const std::string& mechanism,
                      const std::string& parameter) {
  const DefaultTolerance* usual = DefaultToleranceOf(target, mechanism, parameter);
  TERA_CHECK(usual != nullptr, target, mechanism, parameter);
  return usual->half_width;
}

class GroupOf {
 public:
  GroupOf(ParameterTable* table, const std::string& target, EffectTarget kind,
          std::string_view mechanism)
      : table_(table) {
    const int first = static_cast<int>(table->parameters.size());
    table->groups.push_back({{target, &SensorMechanism(mechanism, kind)}, first});
  }
  /// `documented_si` is in SI units; `si_per_unit` converts from the mechanism's unit. The
  /// parameter may differ from the documented value by `range`, in the mechanism's unit.
  GroupOf& Number(const std::string& name, const std::string& unit, double si_per_unit,
                  double documented_si, double range, double wander_share) {
    const ParameterGroup& group = table_->groups.back();
    const std::string id(group.mechanism->id);
    const double usual = si_per_unit * UsualHalfWidth(group.target, id, name);
    const double tolerance =
        std::max(si_per_unit * table_->HalfWidthOf(group.target, id, name), kLeastShare * usual);
    table_->parameters.push_back({name, unit, si_per_unit, documented_si, tolerance,
                                  kFreeShare * usual, wander_share * tolerance,
                                  documented_si - si_per_unit * range,
                                  documented_si + si_per_unit * range});
    ++table_->groups.back().count;
    return *this;
  }
  int first() const { return table_->groups.back().first; }

 private:
  ParameterTable* table_;
};

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

int AddDelay(const std::string& target, EffectTarget kind, const Effects& effects,
             ParameterTable* table) {
  return GroupOf(table, target, kind, kDelay)
      .Number("offset_s", "s", 1, DocumentedDelay_s(effects), kMostDelay_s, kWander)
      .first();
}

int AddShift(const std::string& target, EffectTarget kind, const std::string& mechanism,
             const Effects& effects, const Vec3& range_m, ParameterTable* table) {
  const Vec3 documented_m = VectorOf(effects, mechanism, "x_m", "y_m", "z_m");
  GroupOf group(table, target, kind, mechanism);
  for (std::size_t i = 0; i < 3; ++i) {
    group.Number(std::string(kAxes[i]) + "_m", "m", 1, documented_m[static_cast<int>(i)],
                 range_m[static_cast<int>(i)], kWander);
  }
  return group.first();
}

}  // namespace

double DocumentedDelay_s(const Effects& effects) {
  return NumberOf(effects, "clock_offset", "offset_s", 0) +
         NumberOf(effects, "latency", "delay_s", 0) +
         NumberOf(effects, "filter_delay", "time_constant_s", 0);
}

double ParameterTable::HalfWidthOf(const std::string& target, const std::string& mechanism,
                                   const std::string& parameter) const {
  for (const Tolerance& one : stated) {
    const bool is_this = one.target == target && one.mechanism->id == mechanism &&
                         one.mechanism->parameters[one.parameter].name == parameter;
    if (is_this) return one.half_width;
  }
  return UsualHalfWidth(target, mechanism, parameter);
}

ParameterPrior ParameterTable::PriorWith(const std::vector<int>& free_groups) const {
  const auto count = static_cast<Eigen::Index>(parameters.size());
  ParameterPrior prior;
  prior.documented.resize(count);
  prior.sigma.resize(count);
  prior.lower.resize(count);
  prior.upper.resize(count);
  prior.small.resize(count);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const bool is_free =
        std::find(free_groups.begin(), free_groups.end(), static_cast<int>(g)) != free_groups.end();
    for (int i = groups[g].first; i < groups[g].first + groups[g].count; ++i) {
      const SensorParameter& one = parameters[static_cast<std::size_t>(i)];
      prior.documented[i] = one.documented;
      const double held = one.tolerance - one.taken;
      prior.sigma[i] = is_free ? one.free_sigma : kPriorShare * held;
      prior.small[i] = one.tolerance;
      prior.lower[i] = is_free ? one.lower : std::max(one.least, one.documented - held);
      prior.upper[i] = is_free ? one.upper : one.documented + held;
    }
  }
  return prior;
}

ParameterPrior ParameterTable::FlexiblePrior() const {
  ParameterPrior prior = PriorWith({});
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    prior.sigma[static_cast<Eigen::Index>(i)] = kFlexibleShare * parameters[i].tolerance;
  }
  for (const ParameterGroup& group : groups) {
    if (group.mechanism && group.mechanism->slot == Slot::kSensorTiming) {
      prior.sigma.segment(group.first, group.count) *= kFlexibleDelays;
    }
  }
  prior.lower.setConstant(-std::numeric_limits<double>::infinity());
  prior.upper.setConstant(std::numeric_limits<double>::infinity());
  return prior;
}

Eigen::VectorXd ParameterTable::Wander() const {
  Eigen::VectorXd wander(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    wander[static_cast<Eigen::Index>(i)] = parameters[i].wander;
  }
  return wander;
}

std::vector<int> ParameterTable::Delays() const {
  std::vector<int> delays;
  for (const ParameterGroup& group : groups) {
    if (group.mechanism && group.mechanism->id == kDelay) delays.push_back(group.first);
  }
  return delays;
}

void ParameterTable::LimitTo(const CandidateLibrary& library) {
  for (ParameterGroup& group : groups) {
    group.may_be_named = group.may_be_named && Admits(library, group.mechanism->id);
    for (const auto& [mechanism, ranges] : library.ranges) {
      if (mechanism != group.mechanism) continue;
      for (const NumberRange& range : ranges) {
        for (int i = group.first; i < group.first + group.count; ++i) {
          SensorParameter& one = parameters[static_cast<std::size_t>(i)];
          if (mechanism->parameters[range.index].name != one.name || one.of_share) continue;
          one.lower = one.si_per_unit * range.lower;
          one.upper = one.si_per_unit * range.upper;
          // Linear numbers of a reflection have either sign, depending on its azimuth.
          if (group.mechanism->id == kMultipath) one.lower = -one.upper;
        }
      }
    }
  }
}

void AddImuParameters(const SensorDescription& unit, const Vec3& part_m, ParameterTable* table,
                      UnitChannel* channel) {
  const auto& model = std::get<ImuModel>(unit.model);
  const Effects& effects = unit.effects;
  channel->signs = AxisSigns(effects);
  GroupOf bias(table, unit.name, kImu, "bias");
  channel->bias = bias.first();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string("gyro_") + kAxes[i] + "_degps";
    bias.Number(
        name, "deg/s", kDeg,
        model.gyro_bias_radps[static_cast<int>(i)] + NumberOf(effects, "bias", name, 0) * kDeg, 57,
        kBiasWander);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string("accel_") + kAxes[i] + "_mps2";
    bias.Number(name, "m/s^2", 1,
                model.accel_bias_mps2[static_cast<int>(i)] + NumberOf(effects, "bias", name, 0), 5,
                kBiasWander);
  }
  GroupOf scale(table, unit.name, kImu, "scale");
  channel->scale = scale.first();
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string name = std::string(i < 3 ? "gyro_" : "accel_") + kAxes[i % 3] + "_factor";
    scale.Number(name, "1", 1, NumberOf(effects, "scale", name, 1), 0.4, kWander);
  }
  const Vec3 mount_deg = VectorOf(effects, "mount_rotation", "roll_deg", "pitch_deg", "yaw_deg");
  GroupOf mount(table, unit.name, kImu, "mount_rotation");
  channel->mount = mount.first();
  for (int i = 0; i < 3; ++i) {
    const std::array<const char*, 3> names = {"roll_deg", "pitch_deg", "yaw_deg"};
    mount.Number(names[static_cast<std::size_t>(i)], "deg", kDeg, mount_deg[i] * kDeg, 57, kWander);
  }
  channel->place = AddShift(unit.name, kImu, "imu_lever_arm", effects, part_m, table);
  channel->late = AddDelay(unit.name, kImu, effects, table);
}

void AddLowPass(const SensorDescription& unit, ParameterTable* table, UnitChannel* channel) {
  const double documented_s = NumberOf(unit.effects, kLowPass, "time_constant_s", 0);
  table->parameters[static_cast<std::size_t>(channel->late)].documented -= documented_s;
  channel->low_pass = GroupOf(table, unit.name, kImu, kLowPass)
                          .Number("time_constant_s", "s", 1, documented_s, kMostDelay_s, kWander)
                          .first();
  SensorParameter& one = table->parameters.back();
  one.lower = one.least = 0;
  one.taken = (1 - kLeastShare) * one.tolerance;  // all but kLeastShare goes to the unit's delay
}

std::array<double, 2> DocumentedLimits(const SensorDescription& unit) {
  return {NumberOf(unit.effects, "saturation", "gyro_limit_degps", kNoLimit) * kDeg,
          NumberOf(unit.effects, "saturation", "accel_limit_mps2", kNoLimit)};
}

void AddClipping(const SensorDescription& unit, const std::array<double, 2>& sigma,
                 ParameterTable* table, UnitChannel* channel) {
  const Mechanism& mechanism = SensorMechanism("saturation", kImu);
  channel->clipped = static_cast<int>(table->parameters.size());
  const bool is_documented = std::isfinite(DocumentedLimits(unit)[0]);
  table->groups.push_back({{unit.name, &mechanism}, channel->clipped, 2, !is_documented});
  for (std::size_t i = 0; i < 2; ++i) {
    const EffectParameter& number = mechanism.parameters[i];
    const double si_per_unit = i == 0 ? kDeg : 1;
    SensorParameter share{std::string(number.name), std::string(number.unit), si_per_unit};
    share.documented = is_documented ? 1 : 0;
    share.tolerance = kClippedShare;
    share.taken = (1 - kLeastShare) * kClippedShare;
    share.free_sigma = 1;
    share.lower = -1;
    share.upper = 2;
    share.of_share = {channel->limit[i] / si_per_unit, sigma[i] / si_per_unit,
                      NumberOf(unit.effects, "saturation", number.name, *number.otherwise)};
    table->parameters.push_back(std::move(share));
  }
}

void AddReceiverParameters(const SensorDescription& receiver, const Vec3& part_m, double segment_s,
                           ParameterTable* table, ReceiverChannel* channel) {
  const auto& model = std::get<GnssModel>(receiver.model);
  const Effects& effects = receiver.effects;
  channel->place = AddShift(receiver.name, kGnss, "gnss_lever_arm", effects, part_m, table);
  // Slow errors of a fix act as another datum in each segment, correlated with the previous
  // segment. The estimate treats segments as independent. A larger deviation makes up for it: the
  // mean has the error of the mean of a first-order Gauss-Markov process.
  const double rho = std::exp(-segment_s / model.correlation_time_s);
  const double slowness = std::sqrt((1 + rho) / (1 - rho));
  const double east_m = table->HalfWidthOf(receiver.name, "position_datum", "east_m");
  const double up_m = table->HalfWidthOf(receiver.name, "height_datum", "offset_m");
  const double horizontal = std::max(slowness * model.correlated_horizontal_m / east_m, kWander);
  const double vertical = std::max(slowness * model.correlated_vertical_m / up_m, kWander);
  channel->datum =
      GroupOf(table, receiver.name, kGnss, "position_datum")
          .Number("east_m", "m", 1,
                  model.bias_enu_m.x() + NumberOf(effects, "position_datum", "east_m", 0), 1000,
                  horizontal)
          .Number("north_m", "m", 1,
                  model.bias_enu_m.y() + NumberOf(effects, "position_datum", "north_m", 0), 1000,
                  horizontal)
          .first();
  GroupOf(table, receiver.name, kGnss, "height_datum")
      .Number("offset_m", "m", 1,
              model.bias_enu_m.z() + NumberOf(effects, "height_datum", "offset_m", 0), 120,
              vertical);
  channel->late = AddDelay(receiver.name, kGnss, effects, table);
}

void AddReflectionParameters(const SensorDescription& receiver, ParameterTable* table,
                             ReceiverChannel* channel) {
  const double most_m = LargestReflection_m(std::get<GnssModel>(receiver.model).fix);
  const Effects& effects = receiver.effects;
  const Eigen::Vector4d documented =
      LinearReflection({NumberOf(effects, kMultipath, "horizontal_m", 0),
                        NumberOf(effects, kMultipath, "vertical_m", 0),
                        NumberOf(effects, kMultipath, "azimuth_deg", 0) * kDeg});
  GroupOf group(table, receiver.name, kGnss, kMultipath);
  channel->reflection = group.first();
  for (int i = 0; i < 4; ++i) {
    group.Number(i < 2 ? "horizontal_m" : "vertical_m", "m", 1, documented[i], most_m, kWander);
  }
}

int AddPairYaw(const SensorDescription& receiver, double by_places_rad, ParameterTable* table) {
  const int yaw =
      GroupOf(table, receiver.name, kGnss, "antenna_yaw")
          .Number("yaw_deg", "deg", kDeg,
                  NumberOf(receiver.effects, "antenna_yaw", "yaw_deg", 0) * kDeg, 137, kWander)
          .first();
  SensorParameter& one = table->parameters.back();
  one.taken = std::min(by_places_rad, (1 - kLeastShare) * one.tolerance);
  return yaw;
}

void AddAxisParameters(const std::string& target, const Effects& effects, bool slides, double swing,
                       ParameterTable* table, AxisChannel* channel) {
  constexpr double kWidestScale = 0.5;
  const std::string zero = slides ? "travel_m" : "angle_deg";
  const double si_per_unit = slides ? 1 : kDeg;
  channel->bias =
      GroupOf(table, target, EffectTarget::kEncoderAxis, "bias")
          .Number(zero, slides ? "m" : "deg", si_per_unit,
                  NumberOf(effects, "bias", zero, 0) * si_per_unit, slides ? 1 : 57, kWander)
          .first();
  channel->scale =
      GroupOf(table, target, EffectTarget::kEncoderAxis, "scale")
          .Number("position_factor", "1", 1, NumberOf(effects, "scale", "position_factor", 1),
                  kWidestScale, kWander)
          .first();
  const double zero_tolerance =
      table->parameters[static_cast<std::size_t>(channel->bias)].tolerance;
  table->groups.back().may_be_named = kWidestScale * swing >= zero_tolerance;
}

int AddEncoderDelay(const std::string& target, const Effects& effects, ParameterTable* table) {
  return AddDelay(target, EffectTarget::kEncoder, effects, table);
}

int AddAccelerationGain(const std::string& number, ParameterTable* table) {
  const int place = static_cast<int>(table->parameters.size());
  table->groups.push_back({{number, nullptr}, place, 1, false});
  table->parameters.push_back({"acceleration_gain", "1", 1, 0, kAccelerationGain, kAccelerationGain,
                               0, -kAccelerationGain, kAccelerationGain});
  return place;
}

int AddGroundHeight(ParameterTable* table) {
  const int place = GroupOf(table, "ground", kGnss, "height_datum")
                        .Number("offset_m", "m", 1, 0, 120, kWander)
                        .first();
  table->groups.back().may_be_named = false;
  return place;
}

void AddPoseParameters(bool were_measured, ParameterTable* table, MapChannel* channel) {
  const std::string target(kPoses);
  channel->late = AddDelay(target, kImu, {}, table);
  if (!were_measured) return;
  channel->shift = GroupOf(table, target, kGnss, "position_datum")
                       .Number("east_m", "m", 1, 0, 1000, kBiasWander)
                       .Number("north_m", "m", 1, 0, 1000, kBiasWander)
                       .first();
  GroupOf(table, target, kGnss, "height_datum").Number("offset_m", "m", 1, 0, 120, kBiasWander);
  channel->turn = GroupOf(table, target, kImu, "mount_rotation")
                      .Number("roll_deg", "deg", kDeg, 0, 28, kBiasWander)
                      .Number("pitch_deg", "deg", kDeg, 0, 28, kBiasWander)
                      .Number("yaw_deg", "deg", kDeg, 0, 57, kBiasWander)
                      .first();
}

}  // namespace tera
