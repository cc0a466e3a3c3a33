#include <fmt/format.h>

#include "core/spelling.h"
#include "physics/machine_reading.h"
#include "physics/running_gear.h"

namespace tera {
namespace {

/// A shovel that carries soil needs an enclosed profile of at least this many points.
constexpr std::size_t kMinProfilePoints = 3;

void CheckGearName(const ConfigMap& config, const std::string& name, const MachineModel& model) {
  for (const RunningGear& gear : model.ground_tools.gears) {
    if (gear.name == name) config.Fault("", fmt::format("a track is named '{}' already", name));
  }
}

GearDrive ReadDrive(const ConfigMap& config, double radius_m) {
  GearDrive drive;
  drive.max_rate_radps = config.Number("max_speed_mps", AtLeast(0, "m/s")) / radius_m;
  drive.max_torque_nm = config.Number("max_torque_nm", AtLeast(0, "N m"));
  drive.inertia_kgm2 = config.Number("inertia_kgm2", Positive("kg m2"));
  if (const auto transient = ReadTransient(config)) drive.transient = *transient;
  return drive;
}

void ReadTrack(const std::string& name, const ConfigMap& config, MachineModel* model) {
  const TrackShape shape{.center_B_m = config.Vector3("center_m", Any("m")),
                         .wheelbase_m = config.Number("wheelbase_m", Positive("m")),
                         .radius_m = config.Number("radius_m", Positive("m")),
                         .width_m = config.Number("width_m", Positive("m"))};
  const int gear = static_cast<int>(model->ground_tools.gears.size());
  const int link = ReadLinkName(config, "link", *model);
  model->gear_drives.push_back(ReadDrive(config, shape.radius_m));
  model->ground_tools.gears.push_back({.name = name,
                                       .link = link,
                                       .drive_radius_m = shape.radius_m,
                                       .patches = TrackPatches(shape)});
  if (const auto shoe = config.OptionalMap("shoe")) {
    Visual visual = ReadMesh(*shoe);
    visual.label = SemanticClass::kTrack;
    model->track_visuals.push_back(
        {.gear = gear,
         .shoe = visual,
         .path_B_m = TrackPath(shape),
         .shoe_count = static_cast<int>(shoe->Integer("count", AtLeast(1, "1")))});
  }
}

void ReadWheelSet(const std::string& name, const ConfigMap& config, MachineModel* model) {
  WheelSetShape shape{.radius_m = config.Number("radius_m", Positive("m")),
                      .width_m = config.Number("width_m", Positive("m"))};
  for (const auto& row : config.NumberRows("axles_m", Any("m"), 3, 1)) {
    shape.axles_B_m.emplace_back(row[0], row[1], row[2]);
  }
  const int gear = static_cast<int>(model->ground_tools.gears.size());
  const int link = ReadLinkName(config, "link", *model);
  model->gear_drives.push_back(ReadDrive(config, shape.radius_m));
  model->ground_tools.gears.push_back({.name = name,
                                       .link = link,
                                       .drive_radius_m = shape.radius_m,
                                       .patches = WheelPatches(shape)});
  if (const auto wheel = config.OptionalMap("wheel")) {
    const Visual visual = ReadMesh(*wheel);
    for (const Vec3& axle : shape.axles_B_m) model->wheel_visuals.push_back({gear, visual, axle});
  }
}

void ReadShovel(const std::string& name, const ConfigMap& config, MachineModel* model) {
  Shovel shovel;
  shovel.name = name;
  shovel.link = ReadLinkName(config, "link", *model);
  for (const auto& row : config.NumberRows("profile_m", Any("m"), 2, kMinProfilePoints)) {
    shovel.profile_B_m.emplace_back(row[0], row[1]);
  }
  shovel.width_m = config.Number("width_m", Positive("m"));
  shovel.capacity_m3 = config.Number("capacity_m3", AtLeast(0, "m3"), 0.0);
  shovel.teeth = static_cast<int>(config.Integer("teeth", AtLeast(0, "1"), 0));
  shovel.tooth_length_m = config.Number("tooth_length_m", AtLeast(0, "m"), 0.0);
  model->ground_tools.shovels.push_back(shovel);
}

void ReadCylinder(const std::string& name, const ConfigMap& config, MachineModel* model) {
  CylinderVisual cylinder;
  cylinder.name = name;
  const ConfigMap barrel = config.Map("barrel"), rod = config.Map("rod");
  cylinder.barrel_link = ReadLinkName(barrel, "link", *model);
  cylinder.barrel_pin_m = barrel.Vector3("pin_m", Any("m"));
  cylinder.barrel = ReadMesh(barrel);
  cylinder.rod_link = ReadLinkName(rod, "link", *model);
  cylinder.rod_pin_m = rod.Vector3("pin_m", Any("m"));
  cylinder.rod = ReadMesh(rod);
  model->cylinders.push_back(cylinder);
}

}  // namespace

void ReadRunningGear(const ConfigMap& config, MachineModel* model) {
  for (const auto& [name, map] : config.NamedMaps("tracks")) ReadTrack(name, map, model);
  for (const auto& [name, map] : config.NamedMaps("wheels")) {
    CheckGearName(map, name, *model);
    ReadWheelSet(name, map, model);
  }
  model->gauge_m = config.Number("gauge_m", AtLeast(0, "m"), 0.0);
}

void ReadEquipment(const ConfigMap& config, MachineModel* model) {
  for (const auto& [name, map] : config.NamedMaps("shovels")) ReadShovel(name, map, model);
  for (const auto& [name, map] : config.NamedMaps("cylinders")) ReadCylinder(name, map, model);
  for (const ConfigMap& map : config.List("hull_points")) {
    const int link = ReadLinkName(map, "link", *model);
    for (const auto& row : map.NumberRows("points_m", Any("m"), 3, 1)) {
      model->ground_tools.hull_points.push_back({link, Vec3(row[0], row[1], row[2])});
    }
  }
  for (const auto& [name, map] : config.NamedMaps("frames")) {
    model->frames.push_back(
        {.name = name, .link = ReadLinkName(map, "link", *model), .X_BF = map.PoseXyzRpy()});
  }
}

}  // namespace tera
