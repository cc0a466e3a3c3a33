#include "layout/study/study.h"

#include <fstream>
#include <set>

#include "core/config/plain_name.h"

namespace tera {
namespace {

constexpr double kMostPoints = 1e6;
constexpr double kFarthest_m = 200;
constexpr double kMostRate_hz = 100;

/// Breadth and height of a standing man of the 50th percentile, rounded. The crouching and lying
/// postures are the same body, folded and turned.
std::vector<Posture> CommonPostures() {
  return {{"standing", Vec3(0.30, 0.50, 1.75)},
          {"crouching", Vec3(0.60, 0.50, 1.00)},
          {"lying", Vec3(0.50, 1.75, 0.30)}};
}

SeenFrom ReadSeen(const ConfigMap& config) {
  SeenFrom seen;
  seen.lidar_points_per_m2 =
      config.Number("lidar_points_per_m2", AtLeast(0, "points/m^2"), seen.lidar_points_per_m2);
  seen.camera_px_per_m = config.Number("camera_px_per_m", AtLeast(0, "px/m"), seen.camera_px_per_m);
  seen.reflectance = config.Number("reflectance", Between(0.01, 1, ""), seen.reflectance);
  return seen;
}

AirStudy ReadAir(const ConfigMap& config) {
  constexpr double kMostRain_mmph = 200, kMostSnow_mmph = 20;
  AirStudy air;
  air.visibility_m = config.OptionalNumber("visibility_m", Positive("m")).value_or(0);
  air.rain_mmph = config.Number("rain_mmph", Between(0, kMostRain_mmph, "mm/h"), 0);
  air.snowfall_mmph = config.Number("snowfall_mmph", Between(0, kMostSnow_mmph, "mm/h"), 0);
  return air;
}

PersonStudy ReadPerson(const ConfigMap& config) {
  PersonStudy person;
  std::set<std::string> names;
  for (const ConfigMap& item : config.List("postures")) {
    person.postures.push_back({item.Text("name"), item.Vector3("size_m", Between(0.05, 5, "m"))});
    RequirePlainName(item, "name", person.postures.back().name);
    if (!names.insert(person.postures.back().name).second) {
      item.Fault("name",
                 {FaultKind::kRepeated, "is taken by another posture; give each its own name"});
    }
  }
  if (person.postures.empty()) person.postures = CommonPostures();
  person.lidar_points = config.Number("lidar_points", Positive("points"), person.lidar_points);
  person.camera_px = config.Number("camera_px", Positive("px"), person.camera_px);
  person.cluster_points = static_cast<int>(
      config.Integer("cluster_points", Between(1, kMostPoints, "points"), person.cluster_points));
  person.farthest_m = config.Number("farthest_m", Between(12, kFarthest_m, "m"), person.farthest_m);
  return person;
}

EyeStudy ReadEye(const ConfigMap& config) {
  EyeStudy eye;
  eye.link = config.Text("link");
  eye.place = config.Place("link");
  eye.p_B_m = config.Vector3("xyz_m", Any("m"));
  eye.spacing_m = config.Number("spacing_m", Between(0, 1, "m"), eye.spacing_m);
  eye.circle_m = config.Number("circle_m", Between(1, kFarthest_m, "m"), eye.circle_m);
  eye.rectangle_m = config.Number("rectangle_m", Between(0, kFarthest_m, "m"), eye.rectangle_m);
  eye.height_m = config.Number("height_m", Between(0, 5, "m"), eye.height_m);
  eye.most_masking_m = config.OptionalNumber("most_masking_m", Between(0, kFarthest_m, "m"));
  return eye;
}

ElevationStudy ReadElevation(const ConfigMap& config) {
  const Range place = Between(-kFarthest_m, kFarthest_m, "m");
  ElevationStudy elevation;
  elevation.low_H_m = config.Vector2("low_m", place, elevation.low_H_m);
  elevation.high_H_m = config.Vector2("high_m", place, elevation.high_H_m);
  elevation.cell_m = config.Number("cell_m", Between(0.02, 10, "m"), elevation.cell_m);
  if ((elevation.high_H_m.array() <= elevation.low_H_m.array()).any()) {
    config.Fault("high_m", "need it beyond low_m along x and y");
  }
  return elevation;
}

PrecisionFit ReadFit(const ConfigMap& information, std::string_view key,
                     const PrecisionFit& otherwise) {
  const auto config = information.OptionalMap(key);
  if (!config) return otherwise;
  return {config->Number("a", Between(1e-4, 10, "")), config->Number("b", Between(-10, 10, ""))};
}

InformationStudy ReadInformation(const ConfigMap& config) {
  InformationStudy information;
  information.voxel_m = config.Number("voxel_m", Between(0.1, 5, "m"), information.voxel_m);
  information.lidar = ReadFit(config, "lidar", information.lidar);
  information.camera = ReadFit(config, "camera", information.camera);
  return information;
}

LayoutStudy ReadStudy(const ConfigMap& config) {
  LayoutStudy study;
  study.machine = config.Text("machine", "");
  study.upper = config.Text("upper", "");
  study.machine_place = config.Place("machine");
  study.upper_place = config.Place("upper");
  study.rate_hz = config.Number("rate_hz", Between(0.01, kMostRate_hz, "Hz"), study.rate_hz);
  study.radius_m = config.Number("radius_m", Between(1, kFarthest_m, "m"), study.radius_m);
  study.height_m = config.Number("height_m", Between(0.1, 50, "m"), study.height_m);
  study.points =
      static_cast<int>(config.Integer("points", Between(10, kMostPoints, ""), study.points));
  study.seed = static_cast<std::uint64_t>(
      config.Integer("seed", AtLeast(0, ""), static_cast<std::int64_t>(study.seed)));
  if (config.Has("map_heights_m")) {
    study.map_heights_m = config.Numbers("map_heights_m", Between(0, 20, "m"), 1, 20);
    const std::set<double> heights_m(study.map_heights_m.begin(), study.map_heights_m.end());
    if (heights_m.size() < study.map_heights_m.size()) {
      config.Fault("map_heights_m",
                   {FaultKind::kRepeated, "a height occurs twice; give each once"});
    }
  }
  std::set<std::string> names;
  for (const ConfigMap& item : config.List("zones")) {
    study.zones.push_back(ReadZone(item));
    if (!names.insert(study.zones.back().name).second) {
      item.Fault("name",
                 {FaultKind::kRepeated, "is taken by another zone; give each its own name"});
    }
  }
  if (const auto seen = config.OptionalMap("seen")) study.seen = ReadSeen(*seen);
  if (const auto air = config.OptionalMap("air")) study.air = ReadAir(*air);
  if (const auto person = config.OptionalMap("person")) study.person = ReadPerson(*person);
  if (const auto map = config.OptionalMap("elevation")) study.elevation = ReadElevation(*map);
  if (const auto eye = config.OptionalMap("eye")) study.eye = ReadEye(*eye);
  if (const auto information = config.OptionalMap("information")) {
    study.information = ReadInformation(*information);
  }
  if (study.person.postures.empty()) study.person.postures = CommonPostures();
  return study;
}

/// Whether the file exists and holds only comments and empty lines.
bool HoldsNothing(const std::filesystem::path& file) {
  std::ifstream lines(file);
  if (!lines) return false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != line.npos && line[first] != '#') return false;
  }
  return lines.eof();
}

}  // namespace

LayoutStudy LoadStudy(const std::filesystem::path& file) {
  // All keys have defaults, so a file of comments alone is the default study.
  const bool is_default = file.empty() || HoldsNothing(file);
  const Config config = is_default ? Config::FromText("{}", "study") : Config::FromFile(file);
  LayoutStudy study = ReadStudy(config.root());
  config.Finish();
  study.resolved_yaml = config.ResolvedYaml();
  return study;
}

}  // namespace tera
