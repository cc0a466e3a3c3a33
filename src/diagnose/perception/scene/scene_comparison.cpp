#include "diagnose/perception/scene/scene_comparison.h"

#include <string>
#include <utility>

#include "diagnose/perception/scene/scene_mechanisms.h"

namespace tera {
namespace {

/// A finding of the scene as others are told: a mechanism on a target, with its measures in the
/// order of the mechanism's parameters.
PerceptionFinding NewFinding(std::string_view id, const std::string& target,
                             const std::vector<double>& values, double p_chosen, double p_confirmed,
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
  found.finding.evidence.p = found.finding.evidence.steady_p = p_chosen;
  found.finding.held_out.p = p_confirmed;
  return found;
}

PerceptionFinding FindingOf(const GroundRegion& region, std::deque<Candidate>* candidates) {
  PerceptionFinding found = NewFinding(
      region.upright ? "object_added" : "terrain_height", "ground",
      {region.area_m2, region.volume_m3, region.mean_m, region.lowest_m, region.highest_m},
      region.p_chosen, region.p_confirmed, candidates);
  found.finding.held_out.rmse_before = region.rmse_before_m;
  found.finding.held_out.rmse_after = region.rmse_after_m;
  found.place = {region.centre_W_m, region.low_W_m, region.high_W_m};
  found.intervals_s = region.intervals_s;
  return found;
}

PerceptionFinding FindingOf(const MissingObject& missing, const std::string& name,
                            std::deque<Candidate>* candidates) {
  PerceptionFinding found =
      NewFinding("object_missing", name, {missing.share, static_cast<double>(missing.rays)},
                 missing.p_chosen, missing.p_confirmed, candidates);
  found.finding.held_out.rmse_before = missing.rmse_before_m;
  found.place = {missing.centre_W_m, missing.centre_W_m, missing.centre_W_m};
  return found;
}

PerceptionFinding FindingOf(const DustCloud& cloud, std::deque<Candidate>* candidates) {
  PerceptionFinding found = NewFinding(
      "dust", "air", {static_cast<double>(cloud.returns), cloud.stopped, cloud.high_W_m.z()},
      cloud.p_chosen, cloud.p_confirmed, candidates);
  found.place = {cloud.centre_W_m.head<2>(), cloud.low_W_m.head<2>(), cloud.high_W_m.head<2>()};
  found.intervals_s = cloud.intervals_s;
  return found;
}

}  // namespace

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

void TakeOver(const RangeSource& source, SceneComparison scene, PerceptionDiagnosis* diagnosis) {
  std::deque<Candidate>* candidates = &diagnosis->scene_candidates;
  for (const MissingObject& missing : scene.missing.objects) {
    diagnosis->findings.push_back(FindingOf(missing, source.name_of(missing.object), candidates));
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

}  // namespace tera
