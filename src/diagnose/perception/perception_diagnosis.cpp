#include "diagnose/perception/perception_diagnosis.h"

#include <fmt/format.h>

#include <utility>

#include "diagnose/perception/scans/range_residuals.h"
#include "diagnose/perception/scans/scan_split.h"

namespace tera {
namespace {

/// Share of points that must be compared with something.
constexpr double kLeastJudged = 0.05;
/// Share of points that places may explain, before the sensor is asked first.
constexpr double kMostExplained = 0.5;
constexpr int kRounds = 2;

/// Why nothing can be said of these scans; empty where it can.
std::string ObstacleTo(const RangeSource& source, const ScanSplit& split) {
  if (split.blocks < kFewestBlocks) {
    return fmt::format("its {} scans are spread over {} blocks of a second; need {}",
                       source.scans.size(), split.blocks, kFewestBlocks);
  }
  const auto points = PointsOf(source.scans, split, {Part::kTrain}, 100, {});
  std::size_t judged = 0, all = 0;
  for (const PointResidual& r : ResidualsOf(source, points, source.present)) {
    ++all;
    judged += r.is_judged() ? 1 : 0;
  }
  if (static_cast<double>(judged) < kLeastJudged * static_cast<double>(all) || all == 0) {
    return fmt::format("{} of {} rays meet something in the simulation; need {:.0f} %", judged, all,
                       100 * kLeastJudged);
  }
  return "";
}

PerceptionFinding AsFinding(const GroundRegion& region) {
  PerceptionFinding finding;
  finding.mechanism = region.upright ? "object_added" : "terrain_height";
  finding.slot = region.upright ? "scene" : "ground";
  finding.target = "ground";
  const auto add = [&](const char* name, double value, const char* unit) {
    finding.parameters.push_back({name, unit, value, {}});
  };
  add("area_m2", region.area_m2, "m2");
  add("volume_m3", region.volume_m3, "m3");
  add("mean_m", region.mean_m, "m");
  add("lowest_m", region.lowest_m, "m");
  add("highest_m", region.highest_m, "m");
  finding.rivals = {finding.mechanism};
  finding.p_chosen = region.p_chosen;
  finding.p_confirmed = region.p_confirmed;
  finding.rmse_before = region.rmse_before_m;
  finding.rmse_after = region.rmse_after_m;
  finding.place = {region.centre_W_m, region.low_W_m, region.high_W_m};
  finding.intervals_s = region.intervals_s;
  return finding;
}

PerceptionFinding AsFinding(const MissingObject& missing, const std::string& name) {
  PerceptionFinding finding;
  finding.mechanism = "object_missing";
  finding.slot = "scene";
  finding.target = name;
  finding.parameters = {{"share", "1", missing.share, {}},
                        {"rays", "1", static_cast<double>(missing.rays), {}}};
  finding.rivals = {finding.mechanism};
  finding.p_chosen = missing.p_chosen;
  finding.p_confirmed = missing.p_confirmed;
  finding.rmse_before = missing.rmse_before_m;
  finding.place = {missing.centre_W_m, missing.centre_W_m, missing.centre_W_m};
  return finding;
}

PerceptionFinding AsFinding(const DustCloud& cloud) {
  PerceptionFinding finding;
  finding.mechanism = "dust";
  finding.slot = "scene";
  finding.target = "air";
  finding.parameters = {{"returns", "1", static_cast<double>(cloud.returns), {}},
                        {"stopped_share", "1", cloud.stopped, {}},
                        {"top_m", "m", cloud.high_W_m.z(), {}}};
  finding.rivals = {finding.mechanism};
  finding.p_chosen = cloud.p_chosen;
  finding.p_confirmed = cloud.p_confirmed;
  finding.place = {cloud.centre_W_m.head<2>(), cloud.low_W_m.head<2>(), cloud.high_W_m.head<2>()};
  finding.intervals_s = cloud.intervals_s;
  return finding;
}

/// What of the scene differs under one set of numbers of the sensor.
struct Scene {
  Dust dust;
  GroundMap ground;
  MissingObjects missing;
  std::vector<std::vector<bool>> explained;
  double share = 0;  ///< of the points
};

Scene SceneUnder(const RangeSource& source, const ScanSplit& split, const SensorNumbers& numbers,
                 double scale) {
  Scene scene;
  scene.dust = FindDust(source, split, numbers);
  scene.ground = CompareGround(source, split, numbers, scale, scene.dust.explained);
  scene.missing = FindMissingObjects(source, split, numbers);
  scene.explained = scene.ground.explained;
  double explained = 0, all = 0;
  for (std::size_t s = 0; s < scene.explained.size(); ++s) {
    for (std::size_t p = 0; p < scene.explained[s].size(); ++p) {
      if (scene.missing.explained[s][p] || scene.dust.explained[s][p]) scene.explained[s][p] = true;
      explained += scene.explained[s][p] ? 1 : 0;
      all += 1;
    }
  }
  scene.share = all > 0 ? explained / all : 0;
  return scene;
}

/// Sensor and scene together: a scene that differs in a few places is believed before a sensor that
/// differs everywhere, if the sensor is right elsewhere; else the sensor comes first, without the
/// places that still differ under its numbers.
Scene Together(const RangeSource& source, const ScanSplit& split, SensorSearch* sensor) {
  Scene scene = SceneUnder(source, split, source.present, 1);
  if (scene.share < kMostExplained) {
    *sensor = SearchSensor(source, split, scene.explained);
    if (sensor->findings.empty()) return scene;
  }
  *sensor = SearchSensor(source, split, {});
  for (int round = 0; round < kRounds; ++round) {
    scene = SceneUnder(source, split, sensor->numbers, sensor->scale);
    if (scene.share == 0) break;
    *sensor = SearchSensor(source, split, scene.explained);
  }
  return SceneUnder(source, split, sensor->numbers, sensor->scale);
}

void Explain(const RangeSource& source, const ScanSplit& split, PerceptionDiagnosis* diagnosis) {
  Scene scene = Together(source, split, &diagnosis->sensor);
  for (const SensorFinding& found : diagnosis->sensor.findings) {
    diagnosis->findings.push_back(AsFinding(found, source.target));
  }
  for (const MissingObject& missing : scene.missing.objects) {
    diagnosis->findings.push_back(AsFinding(missing, source.name_of(missing.object)));
  }
  for (const GroundRegion& region : scene.ground.regions) {
    diagnosis->findings.push_back(AsFinding(region));
  }
  for (const DustCloud& cloud : scene.dust.clouds) {
    diagnosis->findings.push_back(AsFinding(cloud));
  }
  for (const SensorFinding& found : diagnosis->sensor.unconfirmed) {
    diagnosis->unconfirmed.push_back(AsFinding(found, source.target));
  }
  for (const GroundRegion& region : scene.ground.unconfirmed) {
    diagnosis->unconfirmed.push_back(AsFinding(region));
  }
  for (const DustCloud& cloud : scene.dust.unconfirmed) {
    diagnosis->unconfirmed.push_back(AsFinding(cloud));
  }
  diagnosis->ground = std::move(scene.ground);
}

}  // namespace

PerceptionDiagnosis NotJudged(const std::string& channel, const std::string& target,
                              const std::string& why) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = channel;
  diagnosis.target = target;
  diagnosis.not_judged = why;
  return diagnosis;
}

PerceptionFinding AsFinding(const SensorFinding& found, const std::string& target) {
  PerceptionFinding finding;
  finding.mechanism = found.mechanism;
  finding.slot = found.mechanism == "extrinsic"      ? "sensor_geometry"
                 : found.mechanism == "clock_offset" ? "sensor_timing"
                                                     : "sensor_static";
  finding.target = target;
  finding.is_effect = true;
  finding.parameters = found.parameters;
  finding.present = found.present;
  finding.rivals.assign(found.rivals.begin(), found.rivals.end());
  finding.p_chosen = found.p_chosen;
  finding.p_confirmed = found.p_confirmed;
  finding.rmse_before = found.rmse_before;
  finding.rmse_after = found.rmse_after;
  return finding;
}

PerceptionDiagnosis DiagnosePerception(const RangeSource& source, std::uint64_t seed) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = source.channel;
  diagnosis.target = source.target;
  diagnosis.scans = source.scans.size();
  const ScanSplit split =
      SplitScans(source.scans, Stream(seed, "diagnose/" + source.channel + "/split"));
  diagnosis.not_judged = ObstacleTo(source, split);
  if (!diagnosis.is_judged()) return diagnosis;
  Explain(source, split, &diagnosis);
  return diagnosis;
}

}  // namespace tera
