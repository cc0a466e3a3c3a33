#pragma once

#include <string>

#include "core/faults.h"
#include "soil/site/site_plan.h"
#include "soil/soil_fixture.h"

/// Sites read from a scenario's terrain mapping, and the faults of one.

namespace tera::testing_soil {

/// Faults of a terrain mapping; empty if it is valid.
inline std::vector<InputFault> FaultsOf(const std::string& terrain_yaml) {
  return FaultsIn([&] { MakeGround(terrain_yaml); });
}

inline SitePlan Plan(const std::string& terrain_yaml, std::uint64_t seed = 1) {
  const Config config = Config::FromText(terrain_yaml, "site.yaml");
  SitePlan plan = ReadSite(config.root(), seed);
  config.Finish();
  return plan;
}

/// Name of the soil that lies at a depth of undisturbed ground.
inline std::string SoilAt(const SitePlan& plan, double x_m, double y_m, double depth_m) {
  const GroundProfile& profile = plan.ground.profiles[plan.ground.ProfileAt(Vec2(x_m, y_m))];
  return plan.kinds.soils()[profile.Below(depth_m).soil].name;
}

}  // namespace tera::testing_soil
