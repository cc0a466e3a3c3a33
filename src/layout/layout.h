#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A sensor rig on the studied machine.
struct Layout {
  std::string name;  ///< its file name without the extension
  std::filesystem::path file;
  std::vector<SensorDescription> sensors;
  std::vector<Viewer> viewers;  ///< lidars and cameras; X_WS at the current moment
};

/// One warning for each lidar whose beams have equal elevation. Its points per solid angle are
/// undefined, so the measures treat it as blind.
std::vector<std::string> FlatWarnings(const Layout& layout);

/// Cost, electrical power and data rate of a rig: sums over its sensors.
struct Expense {
  double cost = 0;  ///< in the rig file's own currency
  double power_w = 0;
  double data_mbyteps = 0;  ///< data rate of uncompressed pictures and scans, MB/s
  /// Number of sensors, of sensors with a cost above 0, and of sensors with a power above 0.
  int sensors = 0, priced = 0, powered = 0;
};
Expense ExpenseOf(const Layout& layout);

/// Index of the studied machine in the scenario, and of its upper structure's link in the machine.
struct StudiedMachine {
  std::size_t machine = 0;
  int upper = 0;
};
/// Throws InputError if the scenario lacks the machine or the machine lacks the link.
StudiedMachine FindMachine(const LayoutStudy& study, const Scenario& scenario);

/// A nameless layout of these sensors. It may have no lidar and no camera.
Layout LayoutOfSensors(std::vector<SensorDescription> sensors, const MachineModel& model);

/// Reads a rig file as a layout on machine number `machine`.
///
/// Throws  InputError if the rig has no lidar and no camera, and as the scenario reader does.
Layout LoadLayout(const std::filesystem::path& file, const Cycle& cycle, std::size_t machine);

/// Shortens the maximum range of all viewers in fog, rain and falling snow.
///
/// Model   lidars: ReachInAir_m. Cameras: the distance at which the air leaves 2 % of the contrast
///         (Koschmieder). In fog alone this distance is the visibility.
/// Omits   dust; the back-scatter of a time-of-flight camera's own light in fog.
void PutInAir(const AirStudy& air, Layout* layout);

/// Sets X_WS of the viewers from the machine's state.
void MoveViewers(const MachineState& machine, Layout* layout);

}  // namespace tera
