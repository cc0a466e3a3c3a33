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

/// One sensor of a rig: kind, mounting, sample times and model.

namespace tera {

struct SensorDescription {
  std::string name;  ///< unique on its machine
  std::string link;  ///< parent link's name; empty for encoders
  Pose X_BS = Pose::Identity();
  SampleClock clock;
  TimeNs latency_ns = 0;         ///< t_available - t
  double cost = 0, power_w = 0;  ///< for the layout search; cost in the currency of the rig
  SensorModel model;
  Effects effects;  ///< from the machine or the scenario; empty for the ideal model
  /// Effects of single encoder axes by name; they override `effects`.
  std::map<std::string, Effects> axis_effects;
};

inline const SensorKind& KindOf(const SensorDescription& sensor) {
  return *kSensorKinds[sensor.model.index()];
}

/// `read` and `model_yaml` of SensorKind for a model that Serialize describes completely.
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

/// True mounting of `sensor`, one of the `sensors` of a machine. Without geometric effects it is
/// the documented mounting. An antenna may be swapped with the only other antenna of the machine.
Mounting TrueMounting(const SensorDescription& sensor,
                      const std::vector<SensorDescription>& sensors);

/// Reads one item of a machine's `sensors:` list: name, link, xyz_m, rpy_deg and the keys of the
/// model. A `preset:` file supplies most keys. Faults go to `config`.
SensorDescription ReadSensor(const ConfigMap& config);

/// Contents of sensor.yaml: type, parent link, X_parent_sensor (row-major 4x4 and xyz +
/// quaternion), rate, model parameters.
std::string SensorYaml(const SensorDescription& sensor);

/// Content of the images; null for a sensor without images.
const PictureContent* PicturesOf(const SensorDescription& sensor);

/// Ranging properties; empty for a sensor without ranges.
std::optional<Ranging> RangingOf(const SensorDescription& sensor);

/// Unoccluded field of view; empty for a sensor without a view.
std::optional<ViewField> ViewOf(const SensorDescription& sensor);

/// Columns of the row samples; empty for other forms of samples.
std::vector<std::string> ColumnsOf(const SensorDescription& sensor, const MachineModel& machine);

}  // namespace tera
