#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"

/// Physical effects beyond the ideal model, by name. The simulator is a chain of slots, each ideal
/// by default. A mechanism is an operator in one slot. Simulation and replay use the same
/// parameters.

namespace tera {

/// Slots in causal order, from a lever to a measurement.
enum class Slot {
  kCommandTiming,
  kLeverMap,
  kFlow,
  kActuator,
  kKinematicGain,
  kLoadFriction,
  kGround,
  kScene,
  kSensorGeometry,
  kSensorStatic,
  kSensorTiming
};

/// Name of a slot in reports: "command_timing".
std::string_view NameOf(Slot slot);

/// Kind of object that a mechanism acts on. YAML addresses a joint, gear, pump or sensor by its
/// name and the whole machine's motion by `base`. One axis of an encoder set has both names:
/// `encoders/boom`. Other sensor kinds define their own targets.
struct EffectTarget {
  std::string_view name;  ///< name in messages: "an imu", "a track or wheel set"

  bool operator==(const EffectTarget&) const = default;

  static const EffectTarget kJoint, kGear, kPump, kBase;
  static const EffectTarget kImu, kGnss, kCamera, kLidar, kEncoder, kEncoderAxis;
};

inline constexpr EffectTarget EffectTarget::kJoint{"a joint"};
inline constexpr EffectTarget EffectTarget::kGear{"a track or wheel set"};
inline constexpr EffectTarget EffectTarget::kPump{"a pump"};
inline constexpr EffectTarget EffectTarget::kBase{"the motion of the machine"};
inline constexpr EffectTarget EffectTarget::kImu{"an imu"};
inline constexpr EffectTarget EffectTarget::kGnss{"a gnss"};
inline constexpr EffectTarget EffectTarget::kCamera{"a camera"};
inline constexpr EffectTarget EffectTarget::kLidar{"a lidar"};
inline constexpr EffectTarget EffectTarget::kEncoder{"a set of encoders"};
inline constexpr EffectTarget EffectTarget::kEncoderAxis{"one axis of a set of encoders"};

/// One numeric parameter of a mechanism.
struct EffectParameter {
  std::string_view name;  ///< key in YAML, with its unit: "delay_s"
  std::string_view unit;  ///< "1" for a dimensionless parameter
  double lower = 0, upper = 0;
  std::optional<double> otherwise;  ///< default, if YAML may omit the parameter
  bool whole = false;               ///< integers only
};

/// A mechanism's definition without parameter values.
struct Mechanism {
  std::string_view id;
  Slot slot = Slot::kLeverMap;
  std::vector<EffectTarget> targets;
  std::vector<EffectParameter> parameters;

  bool ActsOn(EffectTarget target) const;
};

/// A mechanism with its parameter values, in the order of its parameters.
struct Effect {
  const Mechanism* mechanism = nullptr;
  std::vector<double> values;

  /// The value of a parameter that the mechanism must have.
  double operator[](std::string_view parameter) const;
};

/// All effects of one target; each mechanism occurs once.
using Effects = std::vector<Effect>;

/// The effect of mechanism `id`, or nullptr.
const Effect* FindEffect(const Effects& effects, std::string_view id);

/// Reads the mapping of one target, such as `{dead_band: {width: 0.1}, actuator_ring: none}`.
/// `library` may contain one id several times, for targets with different parameters. Only
/// mechanisms that act on `target` are read. `none` removes the effect of a lower layer. `config`
/// receives the faults: another mechanism, a number out of range or an absent parameter.
Effects ReadEffects(const ConfigMap& config, EffectTarget target,
                    std::span<const Mechanism> library);

}  // namespace tera
