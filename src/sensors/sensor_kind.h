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

/// True mounting of a sensor, after effects of the slot `sensor_geometry`.
struct Mounting {
  std::string link;
  Pose X_BT = Pose::Identity();
};

/// All sensors of one machine.
using SensorList = std::vector<SensorDescription>;

/// Complete definition of one sensor kind. All other code iterates over the table of kinds
/// (sensor_kinds.h). This includes rigs, readers of scenarios and effects, re-simulation, `tera
/// serve` and `tera ros2`. Function pointers marked "may be null" are null for a kind without the
/// feature.
struct SensorKind {
  std::string_view name;  ///< `type:` in YAML and name of the channel, for example "imu"
  EffectTarget target;    ///< target of its effects
  ChannelForm form = ChannelForm::kRows;
  bool on_link = true;    ///< mounted on a link at X_BS
  double slowest_hz = 0;  ///< lower bound of `rate_hz`; 0: any positive rate

  /// Reads the keys of the model. Mounting and clock of the description are already set.
  void (*read)(const ConfigMap& config, SensorDescription* sensor);
  /// The keys of the model as YAML, indented by two blanks.
  std::string (*model_yaml)(const SensorDescription& sensor);
  /// Column names with units, for kinds with row samples. May be null.
  std::vector<std::string> (*columns)(const SensorDescription& sensor,
                                      const MachineModel& machine) = nullptr;
  /// Image content, for imaging kinds. May be null.
  const PictureContent* (*pictures)(const SensorDescription& sensor) = nullptr;
  /// Scan content, for scanning kinds. May be null.
  ScanContent (*scans)(const SensorDescription& sensor) = nullptr;
  /// Ranging properties; empty for a sensor of this kind without ranges. May be null.
  std::optional<Ranging> (*ranging)(const SensorDescription& sensor) = nullptr;
  /// Unoccluded field of view. May be null.
  ViewField (*view)(const SensorDescription& sensor) = nullptr;
  std::unique_ptr<SensorSampler> (*sampler)(const SensorPlace& place);

  /// Mechanisms in addition to the common ones (sensor_mechanisms.h). May be null.
  std::vector<Mechanism> (*mechanisms)() = nullptr;
  /// Reports effects that cannot change the measurements. `effects` maps the targets of the machine
  /// to their effects. May be null.
  void (*check_effects)(const ConfigMap& effects, const MachineModel& machine,
                        const SensorDescription& sensor, const SensorList& rig) = nullptr;
  /// True mounting, if TrueMount does not suffice. May be null.
  Mounting (*true_mounting)(const SensorDescription& sensor, const SensorList& rig) = nullptr;

  /// Axes with effects of their own, which have the target `axis_target`. May be null.
  std::vector<EncoderAxis> (*axes)(const SensorDescription& sensor,
                                   const MachineModel& machine) = nullptr;
  EffectTarget axis_target;
  /// Reports names in the keys that do not exist on the machine. May be null.
  void (*check_names)(const ConfigMap& config, const SensorDescription& sensor,
                      const MachineModel& machine) = nullptr;
};

}  // namespace tera
