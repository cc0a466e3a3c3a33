#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/types/terrain_surface.h"
#include "sim/scenario/load_scenario.h"
#include "sim/world_state.h"

namespace tera {

/// Throws InputError if `file` is not a regular file.
void RequireRigFile(const std::filesystem::path& file);

/// A work cycle over which layouts are evaluated. Its source is a dataset with state, which is
/// played back, or a scenario, which is simulated.
///
/// Throws  InputError if the path is neither, and as their readers do.
class Cycle {
 public:
  /// `moved` as in LoadRecordedScenario.
  Cycle(const std::filesystem::path& dataset_or_scenario, std::vector<std::string> moved);

  /// The path of the dataset or scenario, as given.
  std::string name() const { return (is_dataset() ? dataset_ : scenario_file_).string(); }
  /// The scenario's YAML with all references resolved.
  const std::string& resolved_yaml() const { return loaded_.resolved_yaml; }
  const Scenario& scenario() const { return loaded_.scenario; }
  /// The scenario in which machine number `machine` carries the rig of `file`.
  Scenario WithRig(std::size_t machine, const std::filesystem::path& file) const;

  using Visit = std::function<void(const Instant&, const TerrainSurface&)>;
  /// Visits the world at the start and after each physics step to the end of the cycle.
  void ForEachStep(const Visit& visit) const;
  /// Visits the physics steps nearest to multiples of 1 / `rate_hz`. Calls `on_step` after each
  /// physics step, before the visit.
  void ForEachMoment(double rate_hz, const Visit& visit, const Visit& on_step = nullptr) const;

 private:
  bool is_dataset() const { return !dataset_.empty(); }

  std::filesystem::path scenario_file_, dataset_;
  std::vector<std::string> moved_;
  LoadedScenario loaded_;
};

}  // namespace tera
