#include "diagnose/perception/scans/scan_diagnosis.h"

#include <fmt/format.h>

#include <utility>

#include "diagnose/perception/scans/range_residuals.h"
#include "diagnose/perception/scene/scene_comparison.h"

namespace tera {
namespace {

/// Points of a scan that tell whether anything can be compared.
constexpr std::size_t kPointsForComparability = 100;
constexpr double kLeastComparable = 0.05;  ///< share of these points
/// Share of points that the scene may explain and still be believed before the sensor.
constexpr double kMostExplained = 0.5;
constexpr int kRounds = 2;  ///< of sensor and scene in turn

/// Why nothing can be said of these scans; empty where it can.
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

/// Sensor and scene together: a scene that differs in a few places is believed before a sensor that
/// differs everywhere, if the sensor is right elsewhere; else the sensor comes first, without the
/// places that still differ under what was found of it.
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
  for (int round = 0; round < kRounds; ++round) {
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
