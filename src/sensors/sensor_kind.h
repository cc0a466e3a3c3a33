#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/motion.h"
#include "core/types/effects.h"
#include "core/types/measurement.h"
#include "dataset/format/channel.h"
#include "physics/description/machine.h"
#include "sensors/frame_content.h"
#include "sensors/ranging.h"
#include "sensors/sampling.h"
#include "sensors/view_field.h"

namespace tera {

struct SensorDescription;

/// Where a sensor truly sits, slot `sensor_geometry`.
struct Mounting {
  std::string link;
  Pose X_BT = Pose::Identity();
};

/// All sensors of one machine.
using SensorList = std::vector<SensorDescription>;

/// Everything that TERA knows about one kind of sensor. The rig, the reading of scenarios and of
/// effects, re-simulation, `tera serve` and `tera ros2` walk the table of kinds (sensor_kinds.h)
/// and know of none.
///
/// Pointers that may be null say so; without them the kind has nothing of that sort.
struct SensorKind {
  std::string_view name;  ///< `type:` in YAML, and of its channel: "imu"
  EffectTarget target;    ///< of its effects
  ChannelForm form = ChannelForm::kRows;
  bool on_link = true;    ///< sits on a link at X_BS
  double slowest_hz = 0;  ///< least `rate_hz`; 0: any above it

  /// Reads the model's keys into a description whose place and clock are read.
  void (*read)(const ConfigMap& config, SensorDescription* sensor);
  /// The model's keys as YAML, two blanks before each.
  std::string (*model_yaml)(const SensorDescription& sensor);
  /// Columns of a kind whose samples are rows, units at their ends. May be null.
  std::vector<std::string> (*columns)(const SensorDescription& sensor,
                                      const MachineModel& machine) = nullptr;
  /// Of a kind that takes pictures: what they hold. May be null.
  const PictureContent* (*pictures)(const SensorDescription& sensor) = nullptr;
  /// Of a kind that scans: what a scan holds. May be null.
  ScanContent (*scans)(const SensorDescription& sensor) = nullptr;
  /// Of a kind that may measure ranges: how, or nothing where this sensor does not. May be null.
  std::optional<Ranging> (*ranging)(const SensorDescription& sensor) = nullptr;
  /// Of a kind that sees: what it could see. May be null.
  ViewField (*view)(const SensorDescription& sensor) = nullptr;
  std::unique_ptr<SensorSampler> (*sampler)(const SensorPlace& place);

  /// Mechanisms beside those of every kind (sensor_mechanisms.h). May be null.
  std::vector<Mechanism> (*mechanisms)() = nullptr;
  /// Reports effects that would change nothing of what the sensor measures. `effects` is the
  /// machine's mapping of targets. May be null.
  void (*check_effects)(const ConfigMap& effects, const MachineModel& machine,
                        const SensorDescription& sensor, const SensorList& rig) = nullptr;
  /// Where it sits by its effects, if TrueMount does not say it all. May be null.
  Mounting (*true_mounting)(const SensorDescription& sensor, const SensorList& rig) = nullptr;

  /// Axes that have effects of their own beside the sensor's, as `axis_target`. May be null.
  std::vector<EncoderAxis> (*axes)(const SensorDescription& sensor,
                                   const MachineModel& machine) = nullptr;
  EffectTarget axis_target;
  /// Reports names in the sensor's keys that the machine does not have. May be null.
  void (*check_names)(const ConfigMap& config, const SensorDescription& sensor,
                      const MachineModel& machine) = nullptr;
};

}  // namespace tera
