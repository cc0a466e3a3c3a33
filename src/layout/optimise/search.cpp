#include "layout/optimise/search.h"

#include <optional>
#include <set>

#include "core/config/config.h"
#include "core/config/plain_name.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kFarthest_m = 100;
constexpr double kMostGenerations = 1e5, kMostPopulation = 10000, kMostMoments = 1000;
constexpr int kInFours = 4;  ///< the population size must be a multiple of four (NSGA-II)

MountBounds ReadMount(const ConfigMap& config) {
  const Range place = Between(-kFarthest_m, kFarthest_m, "m"), angle = Between(-360, 360, "deg");
  MountBounds mount;
  mount.link = config.Text("link");
  mount.place = config.Place("link");
  mount.low_B_m = config.Vector3("low_xyz_m", place);
  mount.high_B_m = config.Vector3("high_xyz_m", place, mount.low_B_m);
  const Vec3 low_deg = config.Vector3("low_rpy_deg", angle, Vec3::Zero());
  mount.low_rpy_rad = kDeg * low_deg;
  mount.high_rpy_rad = kDeg * config.Vector3("high_rpy_deg", angle, low_deg);
  if ((mount.high_B_m.array() < mount.low_B_m.array()).any()) {
    config.Fault("high_xyz_m", "is below low_xyz_m on some axis; need at least low_xyz_m");
  }
  if ((mount.high_rpy_rad.array() < mount.low_rpy_rad.array()).any()) {
    config.Fault("high_rpy_deg", "is below low_rpy_deg about some axis; need at least low_rpy_deg");
  }
  return mount;
}

/// Whether the preset is a lidar or camera. Reads only the type, because the full reader would
/// demand keys of other sensor types.
bool IsOfWhatSees(const std::filesystem::path& preset) {
  const Config config = Config::FromFile(preset);
  const std::string type = config.root().Text("type", "");
  return type == "lidar" || type == "camera";
}

/// A sensor of a preset, read with a placeholder mount that the search replaces.
TypeChoice ReadType(const ConfigMap& config) {
  TypeChoice type;
  type.preset = config.File("preset");
  const std::optional<double> cost = config.OptionalNumber("cost", AtLeast(0, "")),
                              power_w = config.OptionalNumber("power_w", AtLeast(0, "W"));
  if (type.preset.empty()) return type;  // File has reported the fault
  if (!IsOfWhatSees(type.preset)) {
    config.Fault("preset", "is neither a lidar nor a camera; need one of them");
    return type;
  }
  Config sensor = Config::FromText(
      "{name: any, link: any, preset: \"" + type.preset.string() + "\"}", type.preset.string());
  type.sensor = ReadSensor(sensor.root());
  sensor.Finish();
  if (ViewOf(type.sensor)->is_flat) {
    config.Fault("preset",
                 "is a lidar whose beams all have one elevation, which no figure evaluates; need "
                 "beams at several elevations");
  }
  if (cost) type.sensor.cost = *cost;
  if (power_w) type.sensor.power_w = *power_w;
  return type;
}

SensorSlot ReadSlot(const ConfigMap& config) {
  SensorSlot slot;
  slot.name = config.Text("name");
  slot.place = config.Place("name");
  RequirePlainName(config, "name", slot.name);
  slot.optional = config.Boolean("optional", slot.optional);
  for (const ConfigMap& item : config.List("types")) slot.types.push_back(ReadType(item));
  for (const ConfigMap& item : config.List("mounts")) slot.mounts.push_back(ReadMount(item));
  if (slot.types.empty())
    config.Fault("types", {FaultKind::kMissing, "needs one at least: - {preset: FILE}"});
  if (slot.mounts.empty())
    config.Fault("mounts", {FaultKind::kMissing, "needs one at least: - {link, low_xyz_m}"});
  return slot;
}

Limits ReadLimits(const ConfigMap& config) {
  return {config.OptionalNumber("cost", AtLeast(0, "")),
          config.OptionalNumber("power_w", AtLeast(0, "W")),
          config.OptionalNumber("data_mbyteps", AtLeast(0, "MB/s")),
          config.OptionalNumber("sensors", AtLeast(1, "")), config.Place()};
}

LayoutSearch ReadSearch(const ConfigMap& config) {
  LayoutSearch search;
  search.cycle = config.Text("cycle");
  search.study = config.OptionalFile("study").value_or("");
  search.keep = config.OptionalFile("keep").value_or("");
  std::set<std::string> names;
  for (const ConfigMap& item : config.List("sensors")) {
    search.slots.push_back(ReadSlot(item));
    if (!names.insert(search.slots.back().name).second) {
      item.Fault("name",
                 {FaultKind::kRepeated, "is taken by another sensor; give each its own name"});
    }
  }
  if (search.slots.empty()) config.Fault("sensors", {FaultKind::kMissing, "needs one at least"});
  if (const auto limits = config.OptionalMap("limits")) search.limits = ReadLimits(*limits);
  for (const ConfigMap& item : config.List("objectives")) {
    search.objectives.push_back({item.Text("figure"),
                                 item.Choice("at", {"mean", "worst"}, "mean") == "worst",
                                 item.Place("figure")});
  }
  if (search.objectives.empty()) {
    config.Fault("objectives", {FaultKind::kMissing,
                                "needs one at least: - {figure: zone/around/blind_m3, at: worst}"});
  }
  search.moments =
      static_cast<int>(config.Integer("moments", Between(1, kMostMoments, ""), search.moments));
  search.place = config.Place("moments");
  search.population = static_cast<int>(
      config.Integer("population", Between(8, kMostPopulation, ""), search.population));
  if (search.population % kInFours != 0) {
    config.Fault("population",
                 {FaultKind::kOutOfRange, "is not a multiple of 4, as NSGA-II needs"});
  }
  search.generations = static_cast<int>(
      config.Integer("generations", Between(1, kMostGenerations, ""), search.generations));
  const std::string start = config.Choice("start", {"greedy", "random", "worst"}, "greedy");
  search.start = start == "greedy"   ? SearchStart::kGreedy
                 : start == "random" ? SearchStart::kRandom
                                     : SearchStart::kWorst;
  search.seed = static_cast<std::uint64_t>(config.Integer("seed", AtLeast(0, ""), 1));
  return search;
}

}  // namespace

LayoutSearch LoadSearch(const std::filesystem::path& file) {
  const Config config = Config::FromFile(file);
  LayoutSearch search = ReadSearch(config.root());
  config.Finish();
  // Unlike other paths of a search, the cycle may be a folder.
  search.cycle = (file.parent_path() / search.cycle).lexically_normal();
  return search;
}

}  // namespace tera
