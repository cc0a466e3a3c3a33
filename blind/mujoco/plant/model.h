#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "blind/mujoco/plant/plant_form.h"

namespace tera::blind::mujoco {

struct Deleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, Deleter>;
using DataPtr = std::unique_ptr<mjData, Deleter>;

inline constexpr double kStep_s = 0.001;

/// The machine as a MuJoCo model.
///
/// Model   a free body; hinges for joints and sprockets. Each axis has one actuator that integrates
///         a rate into the position that the oil's spring holds (or a velocity actuator), and
///         filters without force as pilots. Gyros, accelerometers and positions are at sites at the
///         sensors' actual mounts.
/// Omits   collision shapes: the ground acts through Shoes.
struct Model {
  ModelPtr model;
  PerAxis<int> joint{};  ///< joint that the motor turns
  PerAxis<int> gap{};    ///< play between motor and link; -1: none
  PerAxis<int> drive{};  ///< actuators
  PerAxis<int> pilot{};
  PerAxis<int> second_pilot{};                      ///< -1: none
  PerAxis<std::array<int, 8>> line{};               ///< stages of a bus
  PerAxis<double> rated_nm{};                       ///< weight at full reach
  int base = 0;                                     ///< body
  std::array<int, kUnits> gyro{}, accelerometer{};  ///< indices in sensordata
  std::array<int, kReceivers> antenna{};

  /// Index of an actuator's state, negative if it has none.
  int StateOf(int actuator) const { return actuator - (model->nu - model->na); }
};

Model BuildModel(const MachineNumbers& numbers, const PlantForm& form, const Start& start);

/// Places the machine on the ground with its joints at the start.
void PlaceAt(const Model& model, const Start& start, mjData* data);

}  // namespace tera::blind::mujoco
