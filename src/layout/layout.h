#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// A rig on the machine of a study, whose view is evaluated.
struct Layout {
  std::string name;  ///< its file name without the extension
  std::filesystem::path file;
  std::vector<SensorDescription> sensors;
  std::vector<Viewer> viewers;  ///< lidars and cameras; X_WS at the current moment
};

/// A warning for each lidar whose beams all have one elevation: it counts as seeing nothing.
std::vector<std::string> FlatWarnings(const Layout& layout);

/// Cost, power and data of a rig: sums over its sensors.
struct Expense {
  double cost = 0;  ///< in the rig file's own currency
  double power_w = 0;
  double data_mbyteps = 0;  ///< data rate of raw pictures and scans
  /// Number of sensors, and number with a cost and with a power above 0.
  int sensors = 0, priced = 0, powered = 0;
};
Expense ExpenseOf(const Layout& layout);

/// Indices of the machine and the links of a study.
struct StudiedMachine {
  std::size_t machine = 0;
  int upper = 0;
};
/// Throws InputError if the scenario has no machine or link with these names.
StudiedMachine FindMachine(const LayoutStudy& study, const Scenario& scenario);

/// The layout of these sensors on a machine, without a name. It may have no lidar and no camera.
Layout LayoutOfSensors(std::vector<SensorDescription> sensors, const MachineModel& model);

/// Reads a rig.
///
/// Throws  InputError if it has no lidar and no camera, and as scenarios do.
Layout LoadLayout(const std::filesystem::path& file, const Cycle& cycle, std::size_t machine);

/// Shortens the reach of all viewers by fog, rain and falling snow.
///
/// Model   lidars: ReachInAir_m. Cameras: the range at which the air leaves 2 % of the contrast
///         (Koschmieder), which in fog alone is its visibility.
/// Omits   dust; a time-of-flight camera's own light, which fog returns as a lidar's.
void PutInAir(const AirStudy& air, Layout* layout);

/// Sets X_WS of the viewers from the machine's state.
void MoveViewers(const MachineState& machine, Layout* layout);

}  // namespace tera
