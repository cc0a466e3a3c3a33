#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/model_archive.h"
#include "core/motion.h"
#include "core/time.h"
#include "core/types/effects.h"
#include "sensors/sensor_kind.h"
#include "sensors/sensor_kinds.h"

/// One sensor as the rig describes it: what it is, where it sits, when it samples.

namespace tera {

struct SensorDescription {
  std::string name;  ///< unique on its machine
  std::string link;  ///< parent link's name; encoders have none
  Pose X_BS = Pose::Identity();
  SampleClock clock;
  TimeNs latency_ns = 0;         ///< t_available - t
  double cost = 0, power_w = 0;  ///< for layouts; the cost in whatever currency its rig is in
  SensorModel model;
  Effects effects;  ///< of the machine or the scenario; without them, as the model says
  /// Effects of single axes of an encoder, by their names, over `effects`.
  std::map<std::string, Effects> axis_effects;
};

/// The entry of its kind in the table.
inline const SensorKind& KindOf(const SensorDescription& sensor) {
  return *kSensorKinds[sensor.model.index()];
}

/// A kind's entries for a model that Serialize describes in whole.
template <typename Model>
void ReadModelOf(const ConfigMap& config, SensorDescription* sensor) {
  sensor->model = ReadModel<Model>(config);
}
template <typename Model>
std::string YamlOfModel(const SensorDescription& sensor) {
  return ModelYaml(std::get<Model>(sensor.model), 2);
}

/// "imu", "gnss", "camera", "lidar", "encoder" or another name in the table of kinds.
std::string TypeOf(const SensorDescription& sensor);

/// The true mounting of `sensor`, one of the `sensors` of a machine: its place as documented where
/// it has no such effect. An antenna may be exchanged with the only other of its machine.
Mounting TrueMounting(const SensorDescription& sensor,
                      const std::vector<SensorDescription>& sensors);

/// Reads one item of a machine's `sensors:` list: name, link, xyz_m, rpy_deg, and the model's keys,
/// most of which a `preset:` file supplies. Faults go to `config`.
SensorDescription ReadSensor(const ConfigMap& config);

/// The sensor as YAML for its folder's sensor.yaml: type, parent link, X_parent_sensor (row-major
/// 4x4 and xyz + quaternion), rate, model parameters.
std::string SensorYaml(const SensorDescription& sensor);

/// What its pictures hold; null where it takes none.
const PictureContent* PicturesOf(const SensorDescription& sensor);

/// How it measures ranges; nothing where it does not.
std::optional<Ranging> RangingOf(const SensorDescription& sensor);

/// What it could see if nothing stood in the way; nothing where it does not see.
std::optional<ViewField> ViewOf(const SensorDescription& sensor);

/// The columns of its samples where they are rows, else none.
std::vector<std::string> ColumnsOf(const SensorDescription& sensor, const MachineModel& machine);

}  // namespace tera
