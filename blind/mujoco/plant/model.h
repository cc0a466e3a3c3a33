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

/// The machine in MuJoCo's own terms.
///
/// Model   a free body; hinges for joints and sprockets; per axis one actuator that integrates a
///         rate into the place that the oil's spring holds (or a velocity actuator), and filters
///         without force that are its pilots; gyros, accelerometers and places at sites where
///         sensors really are.
/// Omits   shapes: the ground acts through Shoes.
struct Model {
  ModelPtr model;
  PerAxis<int> joint{};  ///< what the motor turns
  PerAxis<int> gap{};    ///< between it and the link; -1: none
  PerAxis<int> drive{};  ///< actuators
  PerAxis<int> pilot{};
  PerAxis<int> second_pilot{};                      ///< -1: none
  PerAxis<std::array<int, 8>> line{};               ///< of a bus with stages
  PerAxis<double> rated_nm{};                       ///< weight at full reach
  int base = 0;                                     ///< body
  std::array<int, kUnits> gyro{}, accelerometer{};  ///< places in sensordata
  std::array<int, kReceivers> antenna{};

  /// Place of an actuator's state, below 0 where it has none.
  int StateOf(int actuator) const { return actuator - (model->nu - model->na); }
};

Model BuildModel(const MachineNumbers& numbers, const PlantForm& form, const Start& start);

/// Puts the machine on the ground and its joints where they start.
void PlaceAt(const Model& model, const Start& start, mjData* data);

}  // namespace tera::blind::mujoco
