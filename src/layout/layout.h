#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "layout/sight/sighting.h"
#include "layout/study/cycle.h"
#include "layout/study/study.h"
#include "sim/scenario/scenario.h"

namespace tera {

/// One rig of which is asked what it sees, on the machine of a study.
struct Layout {
  std::string name;  ///< of its file, without the ending
  std::filesystem::path file;
  std::vector<SensorDescription> sensors;
  std::vector<Viewer> viewers;  ///< its lidars and cameras; X_WS of the moment that is looked at
};

/// Of each of its lidars whose beams all have one elevation, why it counts as seeing nothing.
std::vector<std::string> FlatWarnings(const Layout& layout);

/// What a rig takes besides places: sums over its sensors.
struct Expense {
  double cost = 0;  ///< in the rig file's own currency
  double power_w = 0;
  double data_mbyteps = 0;  ///< of pictures and scans as measured
  /// How many sensors there are, and of how many the rig says a cost and a power above 0.
  int sensors = 0, priced = 0, powered = 0;
};
Expense ExpenseOf(const Layout& layout);

/// The machine and the links that a study is about, by their numbers.
struct StudiedMachine {
  std::size_t machine = 0;
  int upper = 0;
};
/// Throws InputError where the scenario has no machine or link of these names.
StudiedMachine FindMachine(const LayoutStudy& study, const Scenario& scenario);

/// The layout of these sensors on a machine, without a name; it may see nothing.
Layout LayoutOfSensors(std::vector<SensorDescription> sensors, const MachineModel& model);

/// Reads a rig. Throws InputError where it holds no lidar and no camera, and as scenarios do.
Layout LoadLayout(const std::filesystem::path& file, const Cycle& cycle, std::size_t machine);

/// Puts the viewers where they are now.
void MoveViewers(const MachineState& machine, Layout* layout);

}  // namespace tera
