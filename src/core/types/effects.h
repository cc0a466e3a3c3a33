#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"

/// Physical effects that the ideal model lacks, such as dead bands and delays. The simulator is a
/// chain of slots. An empty slot is ideal. A mechanism is an operator that fills one slot.
/// Simulation and replay apply the same parameters.

namespace tera {

/// Slots in causal order, from lever command to measurement.
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

/// Name of a slot in reports, such as "command_timing".
std::string_view NameOf(Slot slot);

/// Kind of object that a mechanism acts on. YAML uses the object's name, or `base` for the motion
/// of the whole machine. An axis of an encoder set is named after both: `encoders/boom`. Sensor
/// types outside this list define their own EffectTarget.
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
  std::optional<double> otherwise;  ///< default; without a default, the parameter is required
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

/// A mechanism with values for its parameters, in the order of Mechanism::parameters.
struct Effect {
  const Mechanism* mechanism = nullptr;
  std::vector<double> values;

  /// Value of the named parameter. The mechanism must define it.
  double operator[](std::string_view parameter) const;
};

/// All effects of one target. A mechanism occurs at most once.
using Effects = std::vector<Effect>;

/// The effect of mechanism `id`, or nullptr.
const Effect* FindEffect(const Effects& effects, std::string_view id);

/// Reads the effects of one target, such as `{dead_band: {width: 0.1}, actuator_ring: none}`. Only
/// mechanisms of `library` that act on `target` are accepted. The library may define the same id
/// twice with different parameters for different targets. The word `none` removes an effect that a
/// lower configuration layer sets. Faults are reported at `config`.
Effects ReadEffects(const ConfigMap& config, EffectTarget target,
                    std::span<const Mechanism> library);

}  // namespace tera
