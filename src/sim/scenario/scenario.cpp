#include "sim/scenario/scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/config/config_faults.h"
#include "core/config/config_peek.h"
#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/units.h"
#include "sim/scenario/collision_meshes.h"
#include "sim/scenario/machine_start.h"
#include "sim/scenario/read_effects.h"
#include "sim/scenario/read_ground.h"
#include "sim/scenario/read_light.h"
#include "sim/scenario/read_tolerances.h"
#include "sim/scenario/read_wear.h"
#include "sim/scenario/task_of_machine.h"

namespace tera {
namespace {

/// One month. A longer duration is rejected as a typing error.
constexpr double kLongest_s = 31 * 86400.0;
constexpr double kMostSeed = 9e15;  ///< below 2^53, so that every YAML reader keeps it exactly
constexpr double kSlowest_hz = 100,
                 kFastest_hz = 5000;  ///< range of step rates at which machines and soil are stable
constexpr double kSlowestPoses_hz = 0.01;
constexpr double kDefaultRate_hz = 500, kDefaultSettle_s = 1.5, kLongestSettle_s = 60;
constexpr double kLeastWheel_m = 0.05, kLargestWheel_m = 3;
constexpr double kLeastMass_kg = 0.1, kLargestMass_kg = 1e5;
constexpr double kShortestLeg_m = 0.1, kLongestLeg_m = 50;
constexpr double kLeastBed_m = 0.3, kLargestBed_m = 30;
constexpr double kMostTip_deg = 75;
constexpr SiteOrigin kDefaultOrigin = {47.3763, 8.5477, 460.0};

/// Reads sensors of known types into `sensors`. Returns whether all types are known.
bool ReadSensors(const ConfigMap& config, const MachineModel& model,
                 std::vector<SensorDescription>* sensors) {
  const auto rig = config.Has("rig") ? std::optional(config.MapOrFile("rig")) : std::nullopt;
  if (!rig) return true;
  bool all_known = true;
  std::set<std::string> names;
  for (const ConfigMap& item : rig->List("sensors")) {
    SensorDescription sensor = ReadSensor(item);
    if (IsUnread(item)) {
      all_known = false;
      continue;
    }
    if (!names.insert(sensor.name).second) {
      item.Fault("name", {FaultKind::kRepeated, "'" + sensor.name +
                                                    "' is taken by another sensor of this machine; "
                                                    "give each its own name"});
    }
    const SensorKind& kind = KindOf(sensor);
    if (kind.check_names) kind.check_names(item, sensor, model);
    if (kind.on_link && model.LinkIndex(sensor.link) < 0) {
      std::vector<std::string> links;
      for (const Link& link : model.links) links.push_back(link.name);
      item.Fault("link", {FaultKind::kNoSuchName,
                          fmt::format("machine '{}' has no link '{}'{}; its links are {}",
                                      model.kind, sensor.link, DidYouMean(sensor.link, links),
                                      fmt::join(links, ", "))});
    }
    sensors->push_back(std::move(sensor));
  }
  return all_known;
}

/// Settings of the scenario that apply to machines by name.
struct OfAllMachines {
  std::optional<ConfigMap> effects, tolerances;
  AbsentMeshes absent = AbsentMeshes::kFault;
};

/// Reads `without_meshes`. The resolved text contains the key only if it is given.
AbsentMeshes ReadAbsentMeshes(const ConfigMap& config) {
  const bool without = config.Has("without_meshes") && config.Boolean("without_meshes", false);
  return without ? AbsentMeshes::kLeftOut : AbsentMeshes::kFault;
}

/// Marks the settings of a machine's parts as read if one of the parts is unknown. This avoids
/// follow-up faults.
void LeaveTargetsUnread(const ConfigMap& description, const OfAllMachines& all,
                        const std::string& name) {
  for (const char* key : {"effects", "tolerances"}) description.Has(key);
  for (const auto* map : {&all.effects, &all.tolerances}) {
    if (*map) (*map)->Has(name);
  }
}

/// Marks the keys of a machine as read if its description has faults. This avoids follow-up faults.
void LeaveUnread(const ConfigMap& config, const ConfigMap& description, const OfAllMachines& all,
                 const std::string& name) {
  for (const char* key : {"start", "operator", "rig", "ground"}) config.Has(key);
  LeaveTargetsUnread(description, all, name);
}

/// Reads a machine, without height and tilt. These are set after all machines have modified the
/// ground.
ScenarioMachine ReadMachineEntry(const ConfigMap& config, const OfAllMachines& all) {
  ScenarioMachine machine;
  machine.placement.name = config.Text("name");
  RequirePlainName(config, "name", machine.placement.name);
  const std::size_t faults_before = FaultCount(config);
  const ConfigMap description = config.MapOrFile("machine");
  machine.placement.model = ReadMachine(description, all.absent);
  SetCollisionMeshes(description, &machine.placement.model);
  const MachineModel& model = machine.placement.model;
  if (model.links.empty()) {
    LeaveUnread(config, description, all, machine.placement.name);
    return machine;
  }
  const bool sound = FaultCount(config) == faults_before;
  ReadStart(config, &machine.placement);
  machine.driver = ReadOperatorPlan(config.Map("operator"), model);
  if (ReadSensors(config, model, &machine.sensors)) {
    machine.tolerances = ReadMachineTolerances(description, all.tolerances, machine.placement.name,
                                               model, machine.sensors);
    ReadMachineEffects(description, all.effects, machine.placement.name, sound,
                       &machine.placement.model, &machine.sensors);
  } else {
    LeaveTargetsUnread(description, all, machine.placement.name);
  }
  ReadGround(config, &machine.placement.model);
  return machine;
}

/// Raises the ground by the effects of all machines, then places the machines on it.
void PlaceOnGround(Site* site, std::vector<ScenarioMachine>* machines) {
  for (const ScenarioMachine& machine : *machines) RaiseGround(machine.placement.model, site);
  for (ScenarioMachine& machine : *machines) SetOnGround(site->surface(), &machine.placement);
}

/// Reads `bed`. By default the hinge is the lower rear edge of the bed.
void ReadBed(const ConfigMap& config, ScenarioObstacle* obstacle) {
  const Range size = Between(kLeastBed_m, kLargestBed_m, "m");
  SoilBed bed;
  bed.floor_B_m = config.Vector3("xyz_m", Any("m"));
  bed.size_m = config.Vector2("size_m", size);
  bed.wall_m = config.Number("wall_m", Between(0, kLargestBed_m, "m"));
  TippingBed& tipping = obstacle->tipping;
  const Vec3 tail_m = bed.floor_B_m - Vec3(0.5 * bed.size_m.x(), 0, 0);
  Vec2 hinge_m(tail_m.x(), tail_m.z());
  if (config.Has("hinge_m")) hinge_m = config.Vector2("hinge_m", Any("m"));
  tipping.hinge_B_m = Vec3(hinge_m.x(), 0, hinge_m.y());
  tipping.gate_B_m = tail_m + Vec3(0, 0, bed.wall_m);
  for (auto [key, visual] : {std::pair{"node", &tipping.visual}, {"gate", &tipping.gate}}) {
    if (!config.Has(key)) continue;
    *visual = obstacle->visual;
    (*visual)->node = config.Text(key);
    (*visual)->place = config.Place(key);
  }
  obstacle->bed = bed;
}

/// Reads `tips`: the angle of the bed over time.
void ReadTips(const ConfigMap& config, ScenarioObstacle* obstacle) {
  if (!config.Has("tips")) return;
  std::vector<TippingBed::Angle>& angles = obstacle->tipping.angles;
  for (const ConfigMap& point : config.List("tips")) {
    angles.push_back({point.Number("t_s", AtLeast(0, "s")),
                      point.Number("angle_deg", Between(0, kMostTip_deg, "deg")) * kDeg});
    if (angles.size() > 1 && angles.back().t_s <= angles[angles.size() - 2].t_s) {
      point.Fault("t_s", "times of tips must grow from point to point");
    }
  }
  if (!angles.empty() && !obstacle->bed) {
    config.Fault("tips",
                 {FaultKind::kInconsistent,
                  "the obstacle has no bed that could tip; give it a 'bed' or remove 'tips'"});
  }
}

/// Centroid of boxes.
Vec3 CentreOf(const std::vector<CollisionBox>& boxes) {
  Vec3 sum_m4 = Vec3::Zero();
  double volume_m3 = 0;
  for (const CollisionBox& box : boxes) {
    sum_m4 += box.size_m.prod() * box.X_BG.translation();
    volume_m3 += box.size_m.prod();
  }
  return volume_m3 > 0 ? Vec3(sum_m4 / volume_m3) : Vec3::Zero();
}

/// Reads `dynamic`. Only an obstacle that is rigid and starts at rest may have it.
void ReadDynamic(const ConfigMap& config, ScenarioObstacle* obstacle) {
  const auto dynamic = config.OptionalMap("dynamic");
  if (!dynamic) return;
  const double mass_kg = dynamic->Number("mass_kg", Between(kLeastMass_kg, kLargestMass_kg, "kg"));
  const Vec3 centre_m = CentreOf(obstacle->collision);
  obstacle->dynamic = {mass_kg, dynamic->Vector3("com_m", Any("m"), centre_m)};
  if (obstacle->collision.empty()) {
    config.Fault("collision", {FaultKind::kMissing,
                               "a dynamic obstacle needs boxes that touch ground and machines"});
  }
  const auto refuse = [&](const char* key) {
    config.Fault(
        key, {FaultKind::kInconsistent,
              fmt::format(
                  "forces move a dynamic obstacle, so it can have no {}; remove 'dynamic' or '{}'",
                  key, key)});
  };
  if (!obstacle->path.empty()) refuse("path");
  if (obstacle->bed) refuse("bed");
  if (!obstacle->wheels.empty()) refuse("wheels");
  if (!obstacle->gait.limbs.empty()) refuse("gait");
}

/// Reads `wheels`, which are nodes of the obstacle's own mesh file. The resolved text contains the
/// key only if it is given.
void ReadWheels(const ConfigMap& config, ScenarioObstacle* obstacle) {
  if (!config.Has("wheels")) return;
  for (const ConfigMap& item : config.List("wheels")) {
    ObstacleWheel wheel;
    wheel.visual = obstacle->visual;
    wheel.visual.node = item.Text("node", "wheel");
    wheel.visual.place = item.Place();
    wheel.axle_B_m = item.Vector3("xyz_m", Any("m"));
    wheel.radius_m = item.Number("radius_m", Between(kLeastWheel_m, kLargestWheel_m, "m"));
    obstacle->wheels.push_back(std::move(wheel));
  }
}

ScenarioObstacle ReadObstacle(const ConfigMap& config, const Wear& wear) {
  config.ApplyPreset("preset");
  ScenarioObstacle obstacle;
  obstacle.name = config.Text("name");
  RequirePlainName(config, "name", obstacle.name);
  const std::string label = config.Text("label");
  if (const auto known = SemanticClassFromName(label)) {
    obstacle.label = *known;
  } else if (!label.empty()) {
    std::vector<std::string> names;
    for (const SemanticClassInfo& info : kSemanticClasses) names.emplace_back(info.name);
    config.Fault("label", {FaultKind::kNoSuchName,
                           "'" + label + "' is not a semantic class" + DidYouMean(label, names)});
  }
  obstacle.visual.mesh = config.File("mesh");
  obstacle.visual.node = config.Text("node", "body");
  obstacle.visual.place = config.Place("mesh");
  obstacle.visual.scale = config.Number("scale", Positive(""), 1.0);
  for (const ConfigMap& box : config.List("collision")) {
    obstacle.collision.push_back({box.PoseXyzRpy(), box.Vector3("size_m", Positive("m"))});
  }
  obstacle.gait = ReadGait(config, obstacle.visual);
  for (const ConfigMap& point : config.List("keypoints")) {
    obstacle.keypoints.push_back({point.Text("name"), point.Vector3("xyz_m", Any("m")),
                                  point.Number("radius_m", AtLeast(0, "m"), 0),
                                  ReadLimbOf(point, obstacle.gait)});
  }
  if (const auto bed = config.OptionalMap("bed")) ReadBed(*bed, &obstacle);
  ReadTips(config, &obstacle);
  ReadWheels(config, &obstacle);
  obstacle.xy_W_m = config.Vector2("xy_m", Any("m"));
  obstacle.yaw_rad = config.Number("yaw_deg", Between(-360, 360, "deg"), 0) * kDeg;
  obstacle.height_above_ground_m = config.Number("height_above_ground_m", Any("m"), 0);
  obstacle.wear = ReadWear(config, wear);
  for (const ConfigMap& point : config.List("path")) {
    obstacle.path.push_back(
        {point.Number("t_s", AtLeast(0, "s")), point.Vector2("xy_m", Any("m"))});
    if (obstacle.path.size() > 1 &&
        obstacle.path.back().t_s <= obstacle.path[obstacle.path.size() - 2].t_s) {
      point.Fault("t_s", "times of a path must grow from point to point");
    }
  }
  ReadDynamic(config, &obstacle);
  return obstacle;
}

/// Index of the name at `key` among `names`. If it is missing there, reports a fault and returns 0.
std::size_t IndexOfNamed(const ConfigMap& config, const char* key,
                         const std::vector<std::string>& names) {
  const std::string name = config.Text(key);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  config.Fault(
      key, {FaultKind::kNoSuchName, fmt::format("there is no '{}'{}; known are: {}", name,
                                                DidYouMean(name, names), fmt::join(names, ", "))});
  return 0;
}

/// Reads an entry of `slings`. There is at least one machine and one obstacle.
Sling ReadSling(const ConfigMap& config, const Scenario& scenario) {
  std::vector<std::string> machines, dynamic, links;
  std::vector<std::size_t> obstacle_of;
  for (const ScenarioMachine& machine : scenario.machines) {
    machines.push_back(machine.placement.name);
  }
  for (std::size_t o = 0; o < scenario.obstacles.size(); ++o) {
    if (!scenario.obstacles[o].dynamic) continue;
    dynamic.push_back(scenario.obstacles[o].name);
    obstacle_of.push_back(o);
  }
  Sling sling;
  sling.machine = IndexOfNamed(config, "machine", machines);
  if (sling.machine < scenario.machines.size()) {
    const MachineModel& model = scenario.machines[sling.machine].placement.model;
    for (const Link& link : model.links) links.push_back(link.name);
  }
  sling.link = static_cast<int>(IndexOfNamed(config, "link", links));
  sling.hook_B_m = config.Vector3("xyz_m", Any("m"));
  const std::size_t load = IndexOfNamed(config, "obstacle", dynamic);
  if (load < obstacle_of.size()) sling.obstacle = obstacle_of[load];
  for (const std::vector<double>& row : config.NumberRows("points_m", Any("m"), 3, 1)) {
    sling.points_T_m.emplace_back(row[0], row[1], row[2]);
  }
  sling.length_m = config.Number("length_m", Between(kShortestLeg_m, kLongestLeg_m, "m"));
  sling.from_s = config.OptionalNumber("from_s", AtLeast(0, "s")).value_or(sling.from_s);
  sling.until_s = config.OptionalNumber("until_s", AtLeast(0, "s")).value_or(sling.until_s);
  if (sling.until_s <= sling.from_s) {
    config.Fault("until_s", {FaultKind::kInconsistent,
                             fmt::format("the sling ends at {:g} s, before it begins at {:g} s",
                                         sling.until_s, sling.from_s)});
  }
  return sling;
}

/// Sets the weather that acts on the ground during the run. In rain the surface is wet from the
/// start, unless the weather before the run is given.
void LetWeatherAct(const ConfigMap& environment, double rain_mmph, Site* site) {
  WeatherSpell weather{.rain_mmph = rain_mmph};
  weather.evaporation_mmpd =
      environment.Number("evaporation_mmpd", Between(0, kMostEvaporation_mmpd, "mm a day"), 0.0);
  if (weather.rain_mmph <= 0 && weather.evaporation_mmpd <= 0) return;
  const bool is_wet = !site->has_weather_before();
  if (site->LetWeatherAct(weather, is_wet)) return;
  environment.Fault(
      weather.rain_mmph > 0 ? "rain_mmph" : "evaporation_mmpd",
      {FaultKind::kOutOfRange,
       "needs more than 255 kinds of soil; need fewer soils, or no weather during the run"});
}

/// Origin of the site: from the scenario, else from the terrain's GeoTIFF, else the default.
SiteOrigin ReadOrigin(const ConfigMap& config, const Site& terrain) {
  SiteOrigin origin = kDefaultOrigin;
  if (terrain.georeference()) origin = *terrain.georeference();
  if (const auto site = config.OptionalMap("site")) {
    origin.lat_deg = site->Number("lat_deg", Between(-90, 90, "deg"), origin.lat_deg);
    origin.lon_deg = site->Number("lon_deg", Between(-180, 180, "deg"), origin.lon_deg);
    origin.height_m = site->Number("height_m", Between(-1000, 10000, "m"), origin.height_m);
  }
  return origin;
}

void RequireUniqueNames(const ConfigMap& config, const Scenario& scenario) {
  std::set<std::string> names;
  const auto require = [&](const std::string& name, std::string_view key) {
    if (!name.empty() && !names.insert(name).second) {
      config.Fault(key,
                   {FaultKind::kRepeated,
                    "name '" + name + "' is used twice; give each machine and obstacle its own"});
    }
    if (name == "truth") {
      config.Fault(key, "name 'truth' is reserved for a folder of every dataset; choose another");
    }
  };
  for (const ScenarioMachine& m : scenario.machines) require(m.placement.name, "machines");
  for (const ScenarioObstacle& o : scenario.obstacles) {
    require(o.name, "obstacles");
    if (o.name == "site") {
      config.Fault("obstacles",
                   "name 'site' is reserved for the walls of a site's mesh; choose another");
    }
  }
  if (!scenario.site_mesh) return;
  for (const SiteMeshPart& part : scenario.site_mesh->parts) require(part.name, "environment");
}

}  // namespace

std::uint64_t SeedOf(const ConfigMap& config) {
  return static_cast<std::uint64_t>(config.Integer("seed", Between(0, kMostSeed, ""), 1));
}

Scenario ReadScenario(const ConfigMap& config) {
  Scenario scenario;
  scenario.name = config.Text("name");
  scenario.seed = SeedOf(config);
  config.Has("randomise");  // LoadScenario handles this key
  if (const auto drawn = config.OptionalMap("drawn")) {
    drawn->Integer("episode", AtLeast(0, ""));
    scenario.drawn = drawn->Texts("values");
  }
  scenario.duration_s =
      config.Number("duration_s", {.min = 0, .max = kLongest_s, .min_excluded = true, .unit = "s"});
  scenario.physics_rate_hz =
      config.Number("physics_rate_hz", Between(kSlowest_hz, kFastest_hz, "Hz"), kDefaultRate_hz);
  scenario.settle_s =
      config.Number("settle_s", Between(0, kLongestSettle_s, "s"), kDefaultSettle_s);
  std::optional<GivenGround> ground;
  if (HasBelow(config, "environment", "mesh")) {
    const ConfigMap environment = config.Map("environment");
    scenario.site_mesh = ReadSiteMesh(environment.Map("mesh"), config.Map("terrain"));
    if (scenario.site_mesh) ground = scenario.site_mesh->ground;
  }
  Site site = Site::Read(config.Map("terrain"), scenario.seed, ground);
  scenario.record = ReadTerrainRecord(config.OptionalMap("record"), site.surface());
  if (const auto record = config.OptionalMap("record")) {
    scenario.poses_hz =
        record->OptionalNumber("poses_hz", Between(kSlowestPoses_hz, kFastest_hz, "Hz"));
  }
  scenario.origin = ReadOrigin(config, site);
  if (const auto environment = config.OptionalMap("environment")) {
    scenario.environment = ReadEnvironment(*environment, scenario.origin);
  }
  const Wear wear = ReadWear(config, {});
  const OfAllMachines all{ReadScenarioEffects(config), ReadScenarioTolerances(config),
                          ReadAbsentMeshes(config)};
  const std::vector<ConfigMap> machines = config.List("machines");
  for (const ConfigMap& machine : machines) {
    scenario.machines.push_back(ReadMachineEntry(machine, all));
    scenario.machines.back().wear = ReadWear(machine, wear);
    CheckRaisedGround(machine, scenario.machines.back().placement.model, site.surface());
    CheckCells(config.Map("terrain"), scenario.machines.back().placement.model, site);
  }
  PlaceOnGround(&site, &scenario.machines);
  if (const auto environment = config.OptionalMap("environment")) {
    LetWeatherAct(*environment, scenario.environment.weather.rain_mmph, &site);
  }
  scenario.site = std::make_shared<const Site>(std::move(site));
  if (const auto task = config.OptionalMap("task")) {
    scenario.task = ReadTask(*task, scenario.site->surface());
  }
  for (std::size_t m = 0; m < scenario.machines.size(); ++m) {
    GiveTask(config.OptionalMap("task"), machines[m], scenario.task, scenario.site->surface(),
             scenario.machines[m].placement, &scenario.machines[m].driver);
  }
  for (const ConfigMap& obstacle : config.List("obstacles")) {
    scenario.obstacles.push_back(ReadObstacle(obstacle, wear));
  }
  if (config.Has("slings")) {
    for (const ConfigMap& sling : config.List("slings")) {
      scenario.slings.push_back(ReadSling(sling, scenario));
    }
  }
  scenario.lamps = ReadLamps(config, [&](const std::string& name) {
    const MachineModel* model = nullptr;
    for (const ScenarioMachine& machine : scenario.machines) {
      if (machine.placement.name == name) model = &machine.placement.model;
    }
    return model;
  });
  if (scenario.machines.empty())
    config.Fault("machines", {FaultKind::kMissing, "no machine given, need at least one"});
  RequireUniqueNames(config, scenario);
  scenario.inputs = config.Inputs();
  return scenario;
}

RigidObstacle RigidPartOf(const ScenarioObstacle& obstacle) {
  RigidObstacle rigid;
  double highest_m = -std::numeric_limits<double>::infinity();
  for (const CollisionBox& box : obstacle.collision) {
    rigid.boxes.push_back({box.X_BG, box.size_m});
    const Vec3 up_G = box.X_BG.linear().row(2);
    highest_m =
        std::max(highest_m, box.X_BG.translation().z() + 0.5 * up_G.cwiseAbs().dot(box.size_m));
  }
  // A dynamic obstacle may be lifted or tipped, so running gear collides with it at any height.
  if (!obstacle.dynamic) rigid.rise_m = obstacle.height_above_ground_m + highest_m;
  return rigid;
}

namespace {

/// Rotation from upright to perpendicular to the mean slope of the ground below an obstacle's
/// boxes.
Mat3 LeanOf(const ScenarioObstacle& obstacle, const Vec2& xy_m, const TerrainSurface& ground) {
  double reach_m = 0;
  for (const CollisionBox& box : obstacle.collision) {
    reach_m = std::max(reach_m, box.X_BG.translation().head<2>().norm() + 0.5 * box.size_m.norm());
  }
  const auto rise = [&](const Vec2& to_m) {
    const Vec2 high = xy_m + to_m, low = xy_m - to_m;
    return (ground.HeightAt(high.x(), high.y()) - ground.HeightAt(low.x(), low.y())) /
           (2 * reach_m);
  };
  const Vec3 normal_W(-rise({reach_m, 0}), -rise({0, reach_m}), 1);
  return Quat::FromTwoVectors(Vec3::UnitZ(), normal_W).toRotationMatrix();
}

}  // namespace

BodyState ObstacleAt(const ScenarioObstacle& obstacle, TimeNs t_ns, const TerrainSurface& ground) {
  BodyState state;
  Vec2 xy_m = obstacle.xy_W_m, velocity_mps = Vec2::Zero();
  double yaw_rad = obstacle.yaw_rad;
  const auto& path = obstacle.path;
  if (!path.empty()) {
    const double t_s = std::clamp(ToSeconds(t_ns), path.front().t_s, path.back().t_s);
    std::size_t i = 0;
    while (i + 2 < path.size() && path[i + 1].t_s <= t_s) ++i;
    xy_m = path[i].xy_W_m;
    if (i + 1 < path.size()) {
      const Vec2 leg_m = path[i + 1].xy_W_m - path[i].xy_W_m;
      const double leg_s = path[i + 1].t_s - path[i].t_s;
      xy_m += leg_m * (t_s - path[i].t_s) / leg_s;
      if (leg_m.norm() > 0) yaw_rad = std::atan2(leg_m.y(), leg_m.x());
      if (t_s == ToSeconds(t_ns) && t_s < path.back().t_s) velocity_mps = leg_m / leg_s;
    }
  }
  const double z_m = ground.HeightAt(xy_m.x(), xy_m.y()) + obstacle.height_above_ground_m;
  Mat3 R_WB = RotationFromRpy(0, 0, yaw_rad);
  if (obstacle.dynamic) R_WB = LeanOf(obstacle, xy_m, ground) * R_WB;
  state.X_WB = MakePose(Vec3(xy_m.x(), xy_m.y(), z_m), R_WB);
  state.v_WB_mps = Vec3(velocity_mps.x(), velocity_mps.y(), 0);
  return state;
}

double TipOf(const ScenarioObstacle& obstacle, TimeNs t_ns) {
  const std::vector<TippingBed::Angle>& angles = obstacle.tipping.angles;
  if (angles.empty()) return 0;
  const double t_s = std::clamp(ToSeconds(t_ns), angles.front().t_s, angles.back().t_s);
  std::size_t k = 1;
  while (k + 1 < angles.size() && angles[k].t_s < t_s) ++k;
  if (k == angles.size()) return angles.front().angle_rad;
  const TippingBed::Angle &from = angles[k - 1], &to = angles[k];
  return from.angle_rad + (to.angle_rad - from.angle_rad) * (t_s - from.t_s) / (to.t_s - from.t_s);
}

Pose TippedBed(const ScenarioObstacle& obstacle, TimeNs t_ns) {
  const Vec3& hinge_m = obstacle.tipping.hinge_B_m;
  return MakePose(hinge_m, RotationFromRpy(0, -TipOf(obstacle, t_ns), 0)) *
         MakePose(Vec3(-hinge_m));
}

double TravelOf(const ScenarioObstacle& obstacle, TimeNs t_ns) {
  double travel_m = 0;
  const double t_s = ToSeconds(t_ns);
  for (std::size_t i = 1; i < obstacle.path.size(); ++i) {
    const PathPoint &from = obstacle.path[i - 1], &to = obstacle.path[i];
    const double share = std::clamp((t_s - from.t_s) / (to.t_s - from.t_s), 0.0, 1.0);
    travel_m += share * (to.xy_W_m - from.xy_W_m).norm();
  }
  return travel_m;
}

}  // namespace tera
