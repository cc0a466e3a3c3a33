#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/units.h"
#include "soil/columns/bed.h"
#include "soil/columns/columns.h"
#include "soil/columns/ground_view.h"
#include "soil/columns/soil_type.h"
#include "soil/flow/avalanche.h"
#include "soil/flow/bed_flow.h"
#include "soil/flow/grains.h"
#include "soil/site/ground_raster.h"
#include "soil/site/site.h"
#include "soil/soil.h"
#include "soil/tool/digging.h"
#include "soil/track/gear_contact.h"
#include "soil/track/hull_contact.h"
#include "soil/track/low_obstacles.h"

namespace tera {
namespace {

/// Soil on columns, with the tools of all machines, grains, beds and avalanches.
class Ground : public Soil {
 public:
  Ground(const Site& site, std::uint64_t seed)
      : columns_(site.columns()),
        avalanche_(columns_.soils()),
        grains_(columns_.soils(), seed),
        piles_kg_(columns_.GroundGain().net_kg),
        weather_(site.weather()) {}

  int AddMachine(const GroundTools& tools) override {
    Machine machine;
    std::vector<SoilType> soils;
    for (const SoilType& soil : columns_.soils())
      soils.push_back(ScaledByFooting(soil, tools.footing));
    for (const Shovel& shovel : tools.shovels) machine.shovels.emplace_back(shovel, soils);
    for (const RunningGear& gear : tools.gears) {
      machine.gears.emplace_back(gear, tools.footing.shears, soils);
      machine.gear_links.push_back(gear.link);
    }
    for (const auto& point : tools.hull_points) {
      machine.hull.emplace_back(point, tools.mass_kg, ClimbHeight_m(tools.gears, point.link));
    }
    machines_.push_back(std::move(machine));
    return static_cast<int>(machines_.size()) - 1;
  }

  SoilReaction Act(int handle, const GroundToolsMotion& motion, double dt_s) override;
  void Flow(double dt_s) override {
    for (std::size_t b = 0; b < bed_flows_.size(); ++b) {
      bed_flows_[b].Flow(dt_s, &grains_.beds()[b], &columns_, &grains_);
    }
    grains_.Step(dt_s, &columns_);
    avalanche_.Flow(dt_s, &columns_, &grains_);
  }
  void LetWeatherAct(TimeNs since_start_ns) override {
    if (!weather_ || !weather_->Advance(since_start_ns)) return;
    columns_.SetWetness(weather_->wetness());
    if (auto water = weather_->TakeWater()) columns_.TakeUp(std::move(*water));
  }
  int AddBed(const SoilBed& bed) override {
    grains_.beds().emplace_back(bed, columns_.soils());
    bed_flows_.emplace_back(columns_.soils());
    return static_cast<int>(grains_.beds().size()) - 1;
  }
  void MoveBed(int handle, const Pose& X_WB, bool gate_is_open) override {
    grains_.beds().at(handle).Move(X_WB, gate_is_open);
  }
  BedLoad bed_load(int handle) const override { return grains_.beds().at(handle).load(); }
  int AddObstacle(const RigidObstacle& obstacle) override { return obstacles_.Add(obstacle); }
  void MoveObstacle(int handle, const BodyState& state) override { obstacles_.Move(handle, state); }

  const TerrainSurface& surface() const override { return columns_.surface(); }
  const std::vector<SoilType>& soils() const override { return columns_.soils(); }
  MassLedger ledger() const override;
  void MarkStart() override { columns_.MarkStart(); }
  std::optional<SoilSample> SampleBelow(double x_m, double y_m, double depth_m) const override {
    return tera::SampleBelow(columns_, x_m, y_m, depth_m);
  }
  SoilVoxels Voxels(const VoxelBox& box) const override { return CutIntoCubes(columns_, box); }
  void WriteGeoTiff(const std::filesystem::path& file, GroundRaster raster,
                    const SiteOrigin& origin, int columns_per_pixel) const override {
    WriteGroundRaster(file, columns_, raster, origin, columns_per_pixel);
  }

 private:
  struct Machine {
    std::vector<Digging> shovels;
    std::vector<GearContact> gears;
    std::vector<int> gear_links;
    std::vector<HullContact> hull;
  };

  Columns columns_;
  Avalanche avalanche_;
  Grains grains_;
  std::vector<BedFlow> bed_flows_;  ///< one for each bed of grains_
  LowObstacles obstacles_;
  double piles_kg_;  ///< mass placed on the site before the start
  std::optional<GroundWeather> weather_;
  std::vector<Machine> machines_;
};

void Add(const Wrench& part, Wrench* sum) {
  sum->force_W_n += part.force_W_n;
  sum->torque_W_nm += part.torque_W_nm;
}

/// The load of a shovel, with hidden soil kinds counted as their given soil.
SoilReaction::Load AsShown(const SoilKinds& kinds, SoilReaction::Load load) {
  for (std::size_t k = kinds.shown_count(); k < load.soil_kg.size(); ++k) {
    load.soil_kg[kinds.Shown(static_cast<std::uint8_t>(k))] += load.soil_kg[k];
  }
  load.soil_kg.resize(kinds.shown_count());
  return load;
}

SoilReaction Ground::Act(int handle, const GroundToolsMotion& motion, double dt_s) {
  TERA_CHECK(handle >= 0 && handle < static_cast<int>(machines_.size()), handle);
  TERA_CHECK(motion.links != nullptr);
  Machine& machine = machines_[handle];
  const std::vector<BodyState>& links = *motion.links;
  TERA_CHECK(motion.gear_rate_radps.size() == machine.gears.size(), motion.gear_rate_radps.size());

  SoilReaction reaction;
  reaction.link_wrench.resize(links.size());
  for (std::size_t k = 0; k < machine.gears.size(); ++k) {
    const int link = machine.gear_links[k];
    const GearContact::Result gear =
        machine.gears[k].Act(links[link], motion.gear_rate_radps[k], dt_s, obstacles_, &columns_);
    Add(gear.wrench, &reaction.link_wrench[link]);
    reaction.gear_traction_n.push_back(gear.traction_n);
    reaction.gear_sinkage_m.push_back(gear.sinkage_m);
    reaction.gear_slip.push_back(gear.slip);
    reaction.gear_grip_n.push_back(gear.grip_n);
  }
  for (HullContact& point : machine.hull) {
    Add(point.Act(links[point.link()], dt_s, columns_, obstacles_),
        &reaction.link_wrench[point.link()]);
  }
  for (Digging& shovel : machine.shovels) {
    const Digging::Result digging = shovel.Act(links[shovel.link()], dt_s, &columns_, &grains_);
    Add(digging.wrench, &reaction.link_wrench[shovel.link()]);
    reaction.shovel_load.push_back(AsShown(columns_.kinds(), digging.load));
  }
  return reaction;
}

MassLedger Ground::ledger() const {
  MassLedger ledger;
  const Columns::Gain gain = columns_.GroundGain();
  ledger.ground_kg = gain.net_kg - piles_kg_;
  ledger.shifted_kg = gain.gained_kg;
  ledger.grains_kg = grains_.mass_kg();
  ledger.outside_kg = columns_.outside_kg();
  ledger.water_kg = columns_.water_kg();
  for (const Bed& bed : grains_.beds()) ledger.beds_kg += bed.mass_kg();
  for (const Machine& machine : machines_) {
    for (const Digging& shovel : machine.shovels) ledger.carried_kg += shovel.carried().mass_kg();
  }
  return ledger;
}

}  // namespace

std::unique_ptr<Soil> MakeSoil(const Site& site, std::uint64_t seed) {
  return std::make_unique<Ground>(site, seed);
}

}  // namespace tera
