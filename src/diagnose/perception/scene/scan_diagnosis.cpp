#include "diagnose/perception/scene/scan_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"
#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scans/range_source.h"
#include "diagnose/perception/scene/dust.h"
#include "diagnose/perception/scene/ground_map.h"
#include "diagnose/perception/scene/missing_objects.h"

namespace tera {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

std::vector<EffectParameter> HeightParameters() {
  return {{"area_m2", "m2", 0, kAny},
          {"volume_m3", "m3", -kAny, kAny},
          {"mean_m", "m", -kAny, kAny},
          {"lowest_m", "m", -kAny, kAny},
          {"highest_m", "m", -kAny, kAny}};
}

std::vector<Mechanism> All() {
  return {{"terrain_height", Slot::kGround, {}, HeightParameters()},
          {"object_added", Slot::kScene, {}, HeightParameters()},
          {"object_missing", Slot::kScene, {}, {{"share", "1", 0, 1}, {"rays", "1", 0, kAny}}},
          {"dust",
           Slot::kScene,
           {},
           {{"returns", "1", 0, kAny}, {"stopped_share", "1", 0, 1}, {"top_m", "m", -kAny, kAny}}}};
}

}  // namespace

std::span<const Mechanism> SceneMechanisms() {
  static const std::vector<Mechanism> mechanisms = All();
  return mechanisms;
}

const Mechanism& SceneMechanism(std::string_view id) {
  const auto found = std::find_if(SceneMechanisms().begin(), SceneMechanisms().end(),
                                  [&](const Mechanism& one) { return one.id == id; });
  TERA_CHECK(found != SceneMechanisms().end(), id);
  return *found;
}

namespace {

struct SceneComparison {
  Dust dust;
  GroundMap ground;
  MissingObjects missing;
  PointFlags explained;        ///< points that any of the differences explains
  double explained_share = 0;  ///< share of all points
};

/// Converts a difference of the scene into a finding. `values` are the measures, in the order of
/// the mechanism's parameters.
PerceptionFinding FindingOf(const SceneDifference& difference, std::string_view id,
                            const std::string& target, const std::vector<double>& values,
                            std::deque<Candidate>* candidates) {
  const Mechanism& mechanism = SceneMechanism(id);
  candidates->push_back({&mechanism, target, {}, {values}, {}});
  PerceptionFinding found;
  found.finding.term = {&candidates->back(), values};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const EffectParameter& parameter = mechanism.parameters[i];
    found.finding.parameters.push_back(
        {std::string(parameter.name), std::string(parameter.unit), values[i], {}});
  }
  found.finding.evidence.rivals = {&candidates->back()};
  found.finding.evidence.p = found.finding.evidence.steady_p = difference.p_chosen;
  found.finding.held_out.p = difference.p_confirmed;
  found.finding.held_out.rmse_before = difference.rmse_before_m;
  found.finding.held_out.rmse_after = difference.rmse_after_m;
  found.place = {difference.centre_W_m, difference.low_W_m, difference.high_W_m};
  found.intervals_s = difference.intervals_s;
  return found;
}

PerceptionFinding FindingOf(const GroundRegion& region, std::deque<Candidate>* candidates) {
  return FindingOf(
      region, region.upright ? "object_added" : "terrain_height", "ground",
      {region.area_m2, region.volume_m3, region.mean_m, region.lowest_m, region.highest_m},
      candidates);
}

PerceptionFinding FindingOf(const DustCloud& cloud, std::deque<Candidate>* candidates) {
  return FindingOf(cloud, "dust", "air",
                   {static_cast<double>(cloud.returns), cloud.stopped, cloud.top_m}, candidates);
}

/// `scale`: actual sensor noise over modelled noise.
SceneComparison CompareScene(const RangeSource& source, const ScanSplit& split,
                             const SensorCalibration& calibration, double scale) {
  SceneComparison scene;
  scene.dust = FindDust(source, split, calibration);
  scene.ground = CompareGround(source, split, calibration, scale, scene.dust.explained);
  scene.missing = FindMissingObjects(source, split, calibration);
  scene.explained = scene.ground.explained;
  double explained = 0, all = 0;
  for (std::size_t s = 0; s < scene.explained.size(); ++s) {
    for (std::size_t p = 0; p < scene.explained[s].size(); ++p) {
      if (scene.missing.explained[s][p] || scene.dust.explained[s][p]) scene.explained[s][p] = true;
      explained += scene.explained[s][p] ? 1 : 0;
      all += 1;
    }
  }
  scene.explained_share = all > 0 ? explained / all : 0;
  return scene;
}

/// Adds the scene's findings and the ground map to the diagnosis. Must follow the sensor's
/// TakeOver, because it needs the sensor's noise.
void TakeOver(const RangeSource& source, SceneComparison scene, PerceptionDiagnosis* diagnosis) {
  std::deque<Candidate>* candidates = &diagnosis->scene_candidates;
  for (const MissingObject& missing : scene.missing.objects) {
    diagnosis->findings.push_back(
        FindingOf(missing, "object_missing", source.name_of(missing.object),
                  {missing.share, static_cast<double>(missing.rays)}, candidates));
  }
  for (const GroundRegion& region : scene.ground.regions) {
    diagnosis->findings.push_back(FindingOf(region, candidates));
  }
  for (const DustCloud& cloud : scene.dust.clouds) {
    diagnosis->findings.push_back(FindingOf(cloud, candidates));
  }
  for (const GroundRegion& region : scene.ground.unconfirmed) {
    diagnosis->unconfirmed.push_back(FindingOf(region, candidates));
  }
  for (const DustCloud& cloud : scene.dust.unconfirmed) {
    diagnosis->unconfirmed.push_back(FindingOf(cloud, candidates));
  }
  for (PerceptionFinding& found : diagnosis->findings) {
    if (!found.place) continue;
    HeldOutError& error = found.finding.held_out;
    error.excess_removed = ExcessRemoved(error, diagnosis->noise_rmse);
    found.finding.is_confirmed = true;
  }
  diagnosis->ground = std::move(scene.ground);
}

/// Points per scan in the test of comparability.
constexpr std::size_t kPointsForComparability = 100;
constexpr double kLeastComparable = 0.05;  ///< share of these points
/// If the scene explains a larger share of the points, the sensor is searched first.
constexpr double kMostExplained = 0.5;
constexpr int kRoundsInTurn = 2;  ///< alternations of sensor and scene

/// Reason why the scans cannot be compared; empty if they can.
std::string ObstacleTo(const RangeSource& source, const ScanSplit& split) {
  if (split.blocks < kFewestBlocks) {
    return fmt::format("its {} scans are spread over {} blocks of a second; need {}",
                       source.scans.size(), split.blocks, kFewestBlocks);
  }
  const auto points = PointsOf(source.scans, split, {Part::kTrain}, kPointsForComparability, {});
  std::size_t judged = 0, all = 0;
  for (const PointResidual& r : ResidualsOf(source, points, source.calibration())) {
    ++all;
    judged += r.is_judged() ? 1 : 0;
  }
  if (static_cast<double>(judged) < kLeastComparable * static_cast<double>(all) || all == 0) {
    return fmt::format("{} of {} rays meet something in the simulation; need {:.0f} %", judged, all,
                       100 * kLeastComparable);
  }
  return "";
}

/// Diagnoses the sensor and the scene together. If the sensor is right outside a few differing
/// places, the scene is the cause. Otherwise the sensor is searched first, and then without the
/// points that the scene explains.
SceneComparison SearchTogether(const RangeSource& source, const ScanSplit& split,
                               const RegistrationBlock& block, RegistrationSearch* sensor) {
  const auto search = [&](const PointFlags& excluded) {
    return SearchRegistration(block, PointsToRegister(source, split, excluded));
  };
  SceneComparison scene = CompareScene(source, split, source.calibration(), 1);
  if (scene.explained_share < kMostExplained) {
    *sensor = search(scene.explained);
    if (sensor->findings.empty()) return scene;
  }
  *sensor = search({});
  for (int round = 0; round < kRoundsInTurn; ++round) {
    scene = CompareScene(source, split, sensor->calibration, sensor->scale);
    if (scene.explained_share == 0) break;
    *sensor = search(scene.explained);
  }
  return CompareScene(source, split, sensor->calibration, sensor->scale);
}

std::vector<TimeNs> TimesOf(const std::vector<RangeScan>& scans) {
  std::vector<TimeNs> t_ns;
  for (const RangeScan& scan : scans) t_ns.push_back(scan.t_ns);
  return t_ns;
}

}  // namespace

PerceptionDiagnosis DiagnoseScans(const RangeSource& source, std::uint64_t seed) {
  PerceptionDiagnosis diagnosis;
  diagnosis.channel = source.channel;
  diagnosis.target = source.target;
  diagnosis.scans = source.scans.size();
  const ScanSplit split =
      SplitScans(TimesOf(source.scans), Stream(seed, "diagnose/" + source.channel + "/split"));
  diagnosis.not_judged = ObstacleTo(source, split);
  if (!diagnosis.is_judged()) return diagnosis;
  RegistrationBlock block = BlockOf(source);
  RegistrationSearch sensor;
  SceneComparison scene = SearchTogether(source, split, block, &sensor);
  TakeOver(std::move(sensor), &diagnosis);
  diagnosis.sensor_candidates = std::move(block.candidates);
  TakeOver(source, std::move(scene), &diagnosis);
  return diagnosis;
}

}  // namespace tera
