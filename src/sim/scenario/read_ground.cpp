#include "sim/scenario/read_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include "physics/traction/ground_faults.h"
#include "physics/traction/track_drive.h"
#include "physics/traction/track_kinematics.h"

namespace tera {
namespace {

/// Mechanisms of track slip. The shear of the soil model already produces slip.
constexpr std::string_view kOfSlip[] = {"track_slip",      "slope_slip", "side_slip",
                                        "effective_gauge", "icr_shift",  "rolling_resistance",
                                        "digging_force"};

constexpr double kRoundingOfCells_m = 1e-9;

GroundModel ReadGroundModel(const ConfigMap& config) {
  const std::string ground =
      config.Choice("ground", {"terramechanics", "ideal", "kinematic"}, "terramechanics");
  if (ground == "ideal") return GroundModel::kIdeal;
  if (ground == "kinematic") return GroundModel::kKinematic;
  return GroundModel::kTerramechanics;
}

/// Reports a fault of a base effect of this machine.
void FaultOfBase(const ConfigMap& config, std::string_view mechanism, const std::string& finding) {
  const ConfigMap base = config.MapOrFile("machine").Map("effects").Map("base");
  base.Fault(mechanism, fmt::format("'{}' {}", mechanism, finding));
}

/// Whether the root link stands on running gear on its left and right side.
bool StandsOnTracks(const MachineModel& model) {
  bool left = false, right = false, on_root = true;
  for (std::size_t g = 0; g < model.ground_tools.gears.size(); ++g) {
    (LeftOfRoot_m(model, g) > 0 ? left : right) = true;
    on_root = on_root && model.ground_tools.gears[g].link == 0;
  }
  return left && right && on_root && model.gauge_m > 0 && !model.fixed_base;
}

/// Reports a tool on the root link: its force could not be separated from that on the running gear.
void CheckTools(const ConfigMap& config, const MachineModel& model) {
  for (const Shovel& shovel : model.ground_tools.shovels) {
    if (shovel.link != 0) continue;
    config.Fault("ground", "shovel '" + shovel.name + "' is on the root link '" +
                               model.links[0].name +
                               "', where ground: kinematic cannot separate its force from that of "
                               "the tracks; give it its own link with a joint of type fixed");
  }
}

}  // namespace

void ReadGround(const ConfigMap& config, MachineModel* model) {
  model->ground = ReadGroundModel(config);
  if (model->ground != GroundModel::kTerramechanics && !StandsOnTracks(*model)) {
    config.Fault("ground",
                 "machine '" + model->kind +
                     "' cannot be moved by the kinematics of tracks; it needs running gear left "
                     "and right on its root link, a gauge_m and no fixed_base, or ground: "
                     "terramechanics");
    model->ground = GroundModel::kTerramechanics;
  }
  if (model->ground != GroundModel::kKinematic) {
    for (const std::string_view id : kOfSlip) {
      if (!FindEffect(model->effects.base, id)) continue;
      FaultOfBase(
          config, id,
          "acts only on a machine with ground: kinematic; choose that or remove the effect");
    }
  }
  if (model->ground == GroundModel::kKinematic) {
    CheckTools(config, *model);
    for (const EffectFault& fault : FaultsOfSlips(*model)) {
      FaultOfBase(config, fault.mechanism, fault.finding);
    }
  }
  SetShoeRatios(model);
  Footing& footing = model->ground_tools.footing;
  footing.shears = model->ground == GroundModel::kTerramechanics;
  if (const Effect* soil = FindEffect(model->effects.base, "soil_strength")) {
    footing.strength = (*soil)["strength"];
    footing.stiffness = (*soil)["stiffness"];
  }
}

void CheckRaisedGround(const ConfigMap& config, const MachineModel& model,
                       const TerrainSurface& site) {
  const Effect* effect = FindEffect(model.effects.base, "terrain_height");
  if (!effect) return;
  const Vec2 low_m = site.origin_W_m;
  const Vec2 high_m = low_m + site.cell_m * Vec2(site.nx - 1, site.ny - 1);
  const Vec2 centre_m((*effect)["x_m"], (*effect)["y_m"]);
  const double reach_m = (*effect)["radius_m"] + (*effect)["edge_m"];
  const Vec2 nearest_m = centre_m.cwiseMax(low_m).cwiseMin(high_m);
  if ((centre_m - nearest_m).norm() < reach_m) return;
  FaultOfBase(config, "terrain_height",
              fmt::format("raises ground only outside the site; need a place within {:g} m of x "
                          "{:g} to {:g} m, y {:g} to {:g} m",
                          reach_m, low_m.x(), high_m.x(), low_m.y(), high_m.y()));
}

void CheckCells(const ConfigMap& terrain, const MachineModel& model, const Site& site) {
  if (!terrain.Has("cell_m")) return;
  const bool yields = std::any_of(site.soils().begin(), site.soils().end(),
                                  [](const SoilType& soil) { return soil.water.holds(); });
  double narrowest_m = std::numeric_limits<double>::infinity();
  for (const RunningGear& gear : model.ground_tools.gears) {
    for (const ContactPatch& patch : gear.patches) {
      narrowest_m = std::min(narrowest_m, patch.width_m);
    }
  }
  const double cell_m = site.surface().cell_m;
  if (!yields || cell_m <= narrowest_m + kRoundingOfCells_m) return;
  terrain.Fault("cell_m",
                {FaultKind::kOutOfRange,
                 fmt::format("{:g} m is wider than a shoe or wheel of a machine, {:.3g} m; need "
                             "cells of at most that, or pavement (asphalt)",
                             cell_m, narrowest_m)});
}

void RaiseGround(const MachineModel& model, Site* site) {
  const Effect* effect = FindEffect(model.effects.base, "terrain_height");
  if (!effect) return;
  site->Raise({.centre_W_m = Vec2((*effect)["x_m"], (*effect)["y_m"]),
               .radius_m = (*effect)["radius_m"],
               .edge_m = (*effect)["edge_m"],
               .height_m = (*effect)["height_m"]});
}

}  // namespace tera
