#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/types/terrain_surface.h"
#include "sim/scenario/load_scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Throws InputError where no file is there that a rig might stand in.
void RequireRigFile(const std::filesystem::path& file);

/// A work cycle that layouts are looked at over: a dataset whose state was kept, or a scenario,
/// which is then simulated.
///
/// Throws InputError where it is neither, and as the reading of either does.
class Cycle {
 public:
  /// `moved` as LoadRecordedScenario takes them.
  Cycle(const std::filesystem::path& dataset_or_scenario, std::vector<std::string> moved);

  /// Of the dataset's folder or the scenario's file, as it was given.
  std::string name() const { return (is_dataset() ? dataset_ : scenario_file_).string(); }
  /// The scenario's text, with everything that it names in place.
  const std::string& resolved_yaml() const { return loaded_.resolved_yaml; }
  const Scenario& scenario() const { return loaded_.scenario; }
  /// The scenario with `file` as the rig of its machine number `machine`.
  Scenario WithRig(std::size_t machine, const std::filesystem::path& file) const;

  using Visit = std::function<void(const Instant&, const TerrainSurface&)>;
  /// Visits the world at the start and after every step of the physics, to the end.
  void ForEachStep(const Visit& visit) const;
  /// Visits it at times as near to multiples of 1 / `rate_hz` as steps come; `on_step` after every
  /// step, and before that visit.
  void ForEachMoment(double rate_hz, const Visit& visit, const Visit& on_step = nullptr) const;

 private:
  bool is_dataset() const { return !dataset_.empty(); }

  std::filesystem::path scenario_file_, dataset_;
  std::vector<std::string> moved_;
  LoadedScenario loaded_;
};

}  // namespace tera
