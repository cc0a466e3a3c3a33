#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"

/// Physics beyond the ideal, by name. The simulator is a chain of slots, each ideal by default; a
/// mechanism is an operator in one slot. The same parameters act in a simulation and in a replay.

namespace tera {

/// Places in the chain from a lever to a measurement, in its order.
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

/// A slot as it is written in reports: "command_timing".
std::string_view NameOf(Slot slot);

/// What a mechanism can act on. In YAML a joint, gear, pump or sensor goes by its name, the motion
/// of the whole machine by `base`, one axis of a set of encoders by both names, `encoders/boom`.
/// A kind of sensor that none of these names brings its own.
struct EffectTarget {
  std::string_view name;  ///< as messages have it: "an imu", "a track or wheel set"

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

/// One number of a mechanism.
struct EffectParameter {
  std::string_view name;  ///< key in YAML, with its unit: "delay_s"
  std::string_view unit;  ///< "1" where it has none
  double lower = 0, upper = 0;
  std::optional<double> otherwise;  ///< where YAML may leave it out
  bool whole = false;               ///< no fractions
};

/// What is known about a mechanism without any values.
struct Mechanism {
  std::string_view id;
  Slot slot = Slot::kLeverMap;
  std::vector<EffectTarget> targets;
  std::vector<EffectParameter> parameters;

  bool ActsOn(EffectTarget target) const;
};

/// A mechanism with its numbers, one for each parameter in that order.
struct Effect {
  const Mechanism* mechanism = nullptr;
  std::vector<double> values;

  /// The number of that name, which the mechanism must have.
  double operator[](std::string_view parameter) const;
};

/// All that one target has; each mechanism once.
using Effects = std::vector<Effect>;

/// The effect of mechanism `id`, or nullptr.
const Effect* FindEffect(const Effects& effects, std::string_view id);

/// Reads the mapping of one target, `{dead_band: {width: 0.1}, actuator_ring: none}`: those
/// mechanisms of `library` that act on `target`; an id may stand there several times, for targets
/// with parameters of their own. `none` takes away what a lower layer has. Faults (another
/// mechanism, a number beyond its range, one missing) go to `config`.
Effects ReadEffects(const ConfigMap& config, EffectTarget target,
                    std::span<const Mechanism> library);

}  // namespace tera
