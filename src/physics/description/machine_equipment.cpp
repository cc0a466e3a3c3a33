#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/config/plain_name.h"
#include "core/config/spelling.h"
#include "core/polygon.h"
#include "core/units.h"
#include "physics/description/machine_reading.h"
#include "physics/description/running_gear.h"

namespace tera {
namespace {

/// Least number of profile points of a shovel that carries soil.
constexpr std::size_t kMinProfilePoints = 3;
constexpr double kLeastProfile_m2 = 1e-4;  ///< points of a smaller profile count as collinear
// Larger values are typing errors.
constexpr double kMostTeeth = 100, kLongestTooth_m = 1, kThickestSteel_m = 0.5, kMostShoes = 1000;
constexpr double kMostRoadWheels = 50, kHighestGrouser_m = 0.3;
constexpr double kLengthTolerance_m = 1e-9;

void CheckProfile(const ConfigMap& config, const std::vector<Vec2>& profile_m) {
  for (std::size_t k = 0; k < profile_m.size(); ++k) {
    const std::size_t next = (k + 1) % profile_m.size();
    if (profile_m[k] == profile_m[next]) {
      config.Fault("profile_m", {FaultKind::kRepeated,
                                 fmt::format("points {} and {} are the same; need each once, the "
                                             "profile being open",
                                             k, next)});
      return;
    }
  }
  if (const auto sides = FirstCrossing(profile_m)) {
    config.Fault("profile_m",
                 fmt::format("the lines from points {} and {} cross; need the points in "
                             "order from the cutting edge to the top edge",
                             sides->first, sides->second));
  } else if (AreaOf(profile_m) < kLeastProfile_m2) {
    config.Fault("profile_m", fmt::format("the points enclose no area ({:.2g} m2); need a "
                                          "cross-section with an inside",
                                          AreaOf(profile_m)));
  }
}

/// A gear's name must differ from joint names: both are columns of the dataset's tables.
void CheckGearName(const ConfigMap& config, const std::string& name, const MachineModel& model) {
  RequirePlainName(config, "", name);
  for (const RunningGear& gear : model.ground_tools.gears) {
    if (gear.name == name)
      config.Fault("", {FaultKind::kRepeated, fmt::format("a track is named '{}' already", name)});
  }
  if (model.JointIndex(name) >= 0) {
    config.Fault("", {FaultKind::kRepeated, fmt::format("a joint is named '{}' already", name)});
  }
}

GearDrive ReadDrive(const ConfigMap& config, double radius_m) {
  GearDrive drive;
  drive.max_rate_radps = config.Number("max_speed_mps", AtLeast(0, "m/s")) / radius_m;
  drive.max_torque_nm = config.Number("max_torque_nm", AtLeast(0, "N m"));
  drive.inertia_kgm2 = config.Number("inertia_kgm2", Positive("kg m2"));
  drive.low_speed_ratio = config.Number(
      "low_speed_ratio", {.min = 0, .max = 1, .min_excluded = true, .unit = "1"}, 1.0);
  drive.displacement_m3prad =
      config.Number("displacement_m3prad", AtLeast(0, "m3/rad"), drive.displacement_m3prad);
  return drive;
}

void ReadRoadWheels(const ConfigMap& config, TrackShape* shape) {
  const auto wheels = config.OptionalMap("road_wheels");
  if (!wheels) return;
  shape->road_wheels = static_cast<int>(wheels->Integer("count", Between(1, kMostRoadWheels, "1")));
  shape->road_wheel_pitch_m = wheels->Number("pitch_m", Positive("m"));
  const double run_m = shape->road_wheels * shape->road_wheel_pitch_m;
  if (run_m > shape->wheelbase_m + kLengthTolerance_m) {
    wheels->Fault(
        "pitch_m",
        {FaultKind::kOutOfRange,
         fmt::format("{} wheels at a pitch of {} m take {:.4g} m, half a pitch at either "
                     "end included; need at most wheelbase_m, {} m",
                     shape->road_wheels, shape->road_wheel_pitch_m, run_m, shape->wheelbase_m)});
  }
}

void ReadTrack(const std::string& name, const ConfigMap& config, MachineModel* model) {
  TrackShape shape{.center_B_m = config.Vector3("center_m", Any("m")),
                   .wheelbase_m = config.Number("wheelbase_m", Positive("m")),
                   .radius_m = config.Number("radius_m", Positive("m")),
                   .width_m = config.Number("width_m", Positive("m"))};
  ReadRoadWheels(config, &shape);
  const int gear = static_cast<int>(model->ground_tools.gears.size());
  const int link = ReadLinkName(config, "link", *model);
  model->gear_drives.push_back(ReadDrive(config, shape.radius_m));
  model->ground_tools.gears.push_back(
      {.name = name,
       .link = link,
       .drive_radius_m = shape.radius_m,
       .grouser_m = config.Number("grouser_m", Between(0, kHighestGrouser_m, "m"), 0.0),
       .patches = TrackPatches(shape)});
  if (const auto shoe = config.OptionalMap("shoe")) {
    Visual visual = ReadMesh(*shoe);
    visual.label = SemanticClass::kTrack;
    const int count = static_cast<int>(shoe->Integer("count", Between(1, kMostShoes, "1")));
    model->track_visuals.push_back(
        {.gear = gear, .shoe = visual, .path_B_m = TrackPath(shape), .shoe_count = count});
    // One rib per shoe.
    model->ground_tools.gears[gear].grouser_pitch_m =
        2 * (shape.wheelbase_m + kPi * shape.radius_m) / count;
  }
}

/// Tolerance of |y| of the unit axle below 1, for a wheel that rolls along x: 11.5 deg.
constexpr double kAxleTolerance = 0.02;

/// Couples the joint of a single wheel to a gear and stores its position in `shape`. A joint that
/// cannot turn the wheel is a fault.
void TakeWheelJoint(const ConfigMap& config, const std::string& name, int gear, int* link,
                    WheelSetShape* shape, MachineModel* model) {
  const int index = model->JointIndex(name);
  std::vector<std::string> known;
  for (const Joint& joint : model->joints) known.push_back(joint.name);
  if (index < 0) {
    config.Fault("joints", {FaultKind::kNoSuchName, fmt::format("there is no joint '{}'{}", name,
                                                                DidYouMean(name, known))});
    return;
  }
  Joint& joint = model->joints[index];
  const Vec3 axis_P = joint.X_PJ.linear() * joint.axis_J;
  const auto refuse = [&](const std::string& finding) {
    config.Fault("joints", fmt::format("joint '{}' {}", name, finding));
  };
  if (joint.type != JointType::kContinuous || joint.following) {
    refuse("does not turn freely without end; need one of type continuous");
  } else if (std::abs(axis_P.y()) < 1 - kAxleTolerance) {
    refuse(
        fmt::format("turns about ({:.3g}, {:.3g}, {:.3g}) of link '{}'; need an axle along its y",
                    axis_P.x(), axis_P.y(), axis_P.z(), model->links[joint.parent].name));
  } else if (joint.gear >= 0) {
    refuse("is of another wheel set already");
  } else if (*link >= 0 && joint.parent != *link) {
    refuse(fmt::format("hangs on link '{}' and others of the set on '{}'; need a set for each",
                       model->links[joint.parent].name, model->links[*link].name));
  } else {
    *link = joint.parent;
    joint.gear = gear;
    joint.gear_ratio = axis_P.y() > 0 ? 1 : -1;
    joint.max_effort_nm = 0;
    shape->axles_B_m.push_back(joint.X_PJ.translation());
  }
}

/// Reads wheel positions from `link` and `axles_m` or from `joints`; returns the link.
int ReadAxles(const ConfigMap& config, int gear, WheelSetShape* shape, MachineModel* model) {
  if (!config.Has("joints")) {
    for (const auto& row : config.NumberRows("axles_m", Any("m"), 3, 1)) {
      shape->axles_B_m.emplace_back(row[0], row[1], row[2]);
    }
    return ReadLinkName(config, "link", *model);
  }
  int link = -1;
  for (const std::string& name : config.Texts("joints")) {
    TakeWheelJoint(config, name, gear, &link, shape, model);
  }
  return std::max(link, 0);
}

void ReadWheelSet(const std::string& name, const ConfigMap& config, MachineModel* model) {
  WheelSetShape shape{.radius_m = config.Number("radius_m", Positive("m")),
                      .width_m = config.Number("width_m", Positive("m"))};
  const int gear = static_cast<int>(model->ground_tools.gears.size());
  const int link = ReadAxles(config, gear, &shape, model);
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
  CheckProfile(config, shovel.profile_B_m);
  shovel.width_m = config.Number("width_m", Positive("m"));
  shovel.capacity_m3 = config.Number("capacity_m3", AtLeast(0, "m3"), 0.0);
  shovel.teeth = static_cast<int>(config.Integer("teeth", Between(0, kMostTeeth, "1"), 0));
  shovel.tooth_length_m = config.Number("tooth_length_m", Between(0, kLongestTooth_m, "m"), 0.0);
  const Range steel = Between(1e-3, kThickestSteel_m, "m");
  shovel.tooth_width_m = config.Number("tooth_width_m", steel, shovel.tooth_width_m);
  shovel.tooth_thickness_m = config.Number("tooth_thickness_m", steel, shovel.tooth_thickness_m);
  shovel.edge_thickness_m = config.Number("edge_thickness_m", steel, shovel.edge_thickness_m);
  if (shovel.teeth * shovel.tooth_width_m > shovel.width_m) {
    config.Fault("teeth",
                 fmt::format("{} of {} m are wider than width_m {}; need room between them",
                             shovel.teeth, shovel.tooth_width_m, shovel.width_m));
  }
  model->ground_tools.shovels.push_back(shovel);
}

}  // namespace

void ReadRunningGear(const ConfigMap& config, MachineModel* model) {
  for (const auto& [name, map] : config.NamedMaps("tracks")) {
    CheckGearName(map, name, *model);
    ReadTrack(name, map, model);
  }
  for (const auto& [name, map] : config.NamedMaps("wheels")) {
    CheckGearName(map, name, *model);
    ReadWheelSet(name, map, model);
  }
  model->gauge_m = config.Number("gauge_m", AtLeast(0, "m"), 0.0);
}

void ReadEquipment(const ConfigMap& config, MachineModel* model) {
  model->ground_tools.mass_kg = model->TotalMass_kg();
  for (const auto& [name, map] : config.NamedMaps("shovels")) {
    RequirePlainName(map, "", name);
    ReadShovel(name, map, model);
  }
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
