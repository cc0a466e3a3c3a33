#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/config/config.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "layout/evaluate.h"
#include "layout/measures/person_samples.h"
#include "layout/resense.h"
#include "sim/run/recorded_run.h"
#include "sim/state/state_log.h"
#include "sim/state/state_playback.h"

// Figures of layouts against scans of datasets generated with them: the gaps of an elevation map
// from the scans, and the points on a person.

namespace tera {
namespace {

namespace fs = std::filesystem;

// A machine at rest before a pile, and a person as a box of known size.
constexpr char kScene[] = R"(
name: ranking
seed: 5
duration_s: 1.0
settle_s: 0.5
terrain: {size_m: [24, 24], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.1, wavelength_m: 5},
          piles: [{xy_m: [4.5, 0.5], height_m: 1.0, soil: dirt}]}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: none.yaml
obstacles:
  - {name: person1, label: person, mesh: person.obj, xy_m: [3.5, -4.5], yaw_deg: -52}
)";

// A lidar on the roof, one that looks over the bonnet from low down, and one tilted down at the
// arm's side. Figures must rank them as the datasets do. A further one on the roof has rows much
// farther apart than its columns.
const std::map<std::string, std::string> kMounts = {
    {"roof",
     "preset: tera:config/sensors/os1_64.yaml, xyz_m: [0.05, 0.35, 2.3], rpy_deg: [0, 10, 0]"},
    {"low", "preset: tera:config/sensors/os1_64.yaml, xyz_m: [0.9, 0.5, 1.0], rpy_deg: [0, 0, 0]"},
    {"tilted",
     "preset: tera:config/sensors/os1_64.yaml, xyz_m: [0.8, 0.5, 2.2], rpy_deg: [0, 32, 0]"},
    {"rows",
     "preset: tera:config/sensors/vlp16.yaml, xyz_m: [0.05, 0.35, 2.3], rpy_deg: [0, 20, 0]"}};

constexpr char kPerson[] = R"(o body
v -0.15 -0.25 0
v 0.15 -0.25 0
v -0.15 0.25 0
v 0.15 0.25 0
v -0.15 -0.25 1.75
v 0.15 -0.25 1.75
v -0.15 0.25 1.75
v 0.15 0.25 1.75
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
)";

/// The dataset of each layout over one recorded scene, and the tool's figures.
class Ranking : public testing::Test {
 protected:
  Ranking() {
    const fs::path folder = scratch_.path();
    WriteWholeFile(folder / "person.obj", kPerson);
    WriteWholeFile(folder / "none.yaml", "sensors: []\n");
    WriteWholeFile(folder / "scene.yaml", kScene);
    const LoadedScenario loaded = LoadScenario(folder / "scene.yaml", {});
    Generate(loaded.scenario, loaded.resolved_yaml, {.out = folder / "base", .keep_state = true});
    study_.rate_hz = 5;
    study_.points = 200;
    const Cycle cycle(folder / "base", {});
    std::vector<Layout> layouts;
    for (const auto& [name, mount] : kMounts) {
      const fs::path rig = folder / (name + ".yaml");
      WriteWholeFile(rig, fmt::format("sensors: [{{name: lidar, link: upper, {}}}]\n", mount));
      layouts.push_back(LoadLayout(rig, cycle, 0));
      Resense(folder / "base", {rig, ""}, {}, {.out = folder / ("data_" + name)});
    }
    reports_ = Evaluate(cycle, study_, layouts, {.threads = 2});
    layouts_ = std::move(layouts);
  }

  fs::path Data(const std::string& name) const { return scratch_.path() / ("data_" + name); }

  /// All scans of a layout's dataset.
  std::vector<LidarScan> ScansOf(const std::string& name) const {
    const Recording recording(Data(name));
    std::vector<LidarScan> scans;
    for (const TimeNs t_ns : recording.FrameTimes("excavator1/lidar")) {
      scans.push_back(recording.LoadScan("excavator1/lidar", t_ns));
    }
    return scans;
  }

  const ScratchDirectory scratch_;
  LayoutStudy study_ = LoadStudy({});
  std::vector<Layout> layouts_;
  std::vector<LayoutReport> reports_;
};

/// Mean share of the cells of the study's map without a point of one scan.
double GapsOf(const std::vector<LidarScan>& scans, const Pose& X_HS, const ElevationStudy& map) {
  const Vec2 size_m = map.high_H_m - map.low_H_m;
  const auto nx = std::lround(size_m.x() / map.cell_m), ny = std::lround(size_m.y() / map.cell_m);
  double gaps = 0;
  for (const LidarScan& scan : scans) {
    std::vector<bool> has_point(static_cast<std::size_t>(nx * ny), false);
    for (const LidarPoint& point : scan.points) {
      if (point.instance != 0) continue;  // not of the ground
      const Vec3 p_H_m = X_HS * Vec3(point.x_m, point.y_m, point.z_m);
      const Vec2 cell = (p_H_m.head<2>() - map.low_H_m) / map.cell_m;
      if (cell.x() < 0 || cell.y() < 0) continue;
      const auto i = static_cast<long>(cell.x()), j = static_cast<long>(cell.y());
      if (i < nx && j < ny) has_point[static_cast<std::size_t>(i * ny + j)] = true;
    }
    gaps += static_cast<double>(std::count(has_point.begin(), has_point.end(), false)) /
            static_cast<double>(has_point.size());
  }
  return gaps / static_cast<double>(scans.size());
}

TEST_F(Ranking, OfElevationMapsIsThatOfMapsMadeFromDatasets) {
  const LoadedScenario loaded = LoadRecordedScenario(scratch_.path() / "base", {}, {});
  const StatePlayback playback(loaded.scenario, loaded.resolved_yaml,
                               scratch_.path() / "base" / kStateFile);
  const MachineState& machine = playback.state().machines[0];
  const int upper = FindMachine(study_, loaded.scenario).upper;
  Pose X_WH = Levelled(machine.links[upper].X_WB);
  X_WH.translation().z() =
      playback.ground().HeightAt(X_WH.translation().x(), X_WH.translation().y());
  std::vector<std::pair<double, double>> predicted_and_real;
  for (std::size_t l = 0; l < layouts_.size(); ++l) {
    MoveViewers(machine, &layouts_[l]);
    const Pose X_HS = X_WH.inverse() * layouts_[l].viewers[0].X_WS;
    const double real = GapsOf(ScansOf(layouts_[l].name), X_HS, study_.elevation);
    const double predicted = MeanOf(*FindFigure(reports_[l], {Measure::kElevationGaps}));
    RecordProperty(layouts_[l].name, fmt::format("{:.3f} predicted, {:.3f} real", predicted, real));
    if (layouts_[l].name == "rows") {
      // Rows 2 deg apart lie more than a cell of 0.2 m apart on the ground. At the steepest
      // depression of 35 deg, from at least 2.3 m above: 2.3 m / sin^2(35 deg) 2 deg = 0.24 m. The
      // figure does not know the gaps between them.
      EXPECT_GT(real, predicted);
      continue;
    }
    predicted_and_real.emplace_back(predicted, real);
    // Beams are in rows, which leave fewer empty cells than random points if they are closer than a
    // cell. Between a Poisson process' exp(-n) and 1 - n lies at most 1/e.
    EXPECT_NEAR(predicted, real, 0.1) << layouts_[l].name;
  }
  std::sort(predicted_and_real.begin(), predicted_and_real.end());
  EXPECT_TRUE(std::is_sorted(predicted_and_real.begin(), predicted_and_real.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; }));
}

TEST_F(Ranking, PointsOnAPersonAreThoseCountedInADataset) {
  const LoadedScenario loaded = LoadRecordedScenario(scratch_.path() / "base", {}, {});
  const SceneAssembly assembly(loaded.scenario);
  const StatePlayback playback(loaded.scenario, loaded.resolved_yaml,
                               scratch_.path() / "base" / kStateFile);
  Sighting sighting(loaded.scenario, assembly, 1);
  sighting.Show(playback.state(), playback.ground());
  const Pose X_WP = playback.state().obstacles[0].X_WB;
  const std::vector<BodyPatch> patches = PatchesOf({"person", Vec3(0.3, 0.5, 1.75)});
  int seeing = 0;
  for (Layout& layout : layouts_) {
    MoveViewers(playback.state().machines[0], &layout);
    const double expected =
        SamplesOnPersons(patches, {X_WP}, layout.viewers[0], 0.3, sighting).front();
    const std::vector<LidarScan> scans = ScansOf(layout.name);
    double counted = 0;
    for (const LidarScan& scan : scans) {
      counted += static_cast<double>(std::count_if(
          scan.points.begin(), scan.points.end(),
          [](const LidarPoint& p) { return p.label == std::uint8_t(SemanticClass::kPerson); }));
    }
    counted /= static_cast<double>(scans.size());
    // At least three standard errors of a count, since the rows of beams on the person are random.
    EXPECT_NEAR(expected, counted, std::max(0.05 * counted, 3 * std::sqrt(counted))) << layout.name;
    RecordProperty(layout.name, fmt::format("{:.0f} expected, {:.0f} counted", expected, counted));
    seeing += counted > 0;
  }
  EXPECT_GE(seeing, 2);  // the low lidar faces the machine's own arm
}

}  // namespace
}  // namespace tera
