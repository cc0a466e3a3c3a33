#include "layout/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/units.h"
#include "dataset/format/sample_recording.h"
#include "layout/evaluate.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr char kLayoutScene[] = R"(
name: scene
duration_s: 0.4
settle_s: 0
physics_rate_hz: 200
terrain: {size_m: [30, 30], cell_m: 0.2, soil: dirt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, -2], yaw_deg: 20}
    operator: {type: idle}
    rig: front.yaml
  - {name: mast1, machine: tera:config/machines/mast.yaml, start: {xy_m: [8, 8]}, operator: {type: idle}}
EFFECTS
)";

constexpr char kRig[] = R"(sensors:
  - {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, cost: 100, power_w: 0.5}
  - {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1],
     rpy_deg: [1, 2, 30], columns: 500, cost: 4000, power_w: 8}
  - {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: boom, xyz_m: [1, 0, 0.4], rpy_deg: [0, 30, 0], cost: 400}
)";

class SceneLayouts : public testing::Test {
 protected:
  SceneLayouts() {
    WriteScene("");
    WriteWholeFile(path() / "front.yaml", kRig);
  }
  const std::filesystem::path& path() const { return scratch_.path(); }
  void WriteScene(const std::string& effects) {
    std::string scene = kLayoutScene;
    WriteWholeFile(path() / "scene.yaml", scene.replace(scene.find("EFFECTS"), 7, effects));
  }
  Cycle TheCycle() const { return Cycle(path() / "scene.yaml", {}); }
  Layout Load(const std::string& rig) {
    WriteWholeFile(path() / "another.yaml", rig);
    return LoadLayout(path() / "another.yaml", TheCycle(), 0);
  }

  const ScratchDirectory scratch_;
};

TEST_F(SceneLayouts, HasTheLidarsAndCamerasOfItsRig) {
  const Layout layout = LoadLayout(path() / "front.yaml", TheCycle(), 0);
  EXPECT_EQ(layout.name, "front");
  EXPECT_EQ(layout.sensors.size(), 3u);
  ASSERT_EQ(layout.viewers.size(), 2u);
  EXPECT_EQ(layout.viewers[0].name, "lidar");
  EXPECT_EQ(layout.viewers[0].field.samples, ViewField::Samples::kPoints);
  EXPECT_TRUE(layout.viewers[0].X_BS.isApprox(
      MakePose({0, 0.3, 2.1}, 1 * kDeg, 2 * kDeg, 30 * kDeg), 1e-12));
  EXPECT_EQ(layout.viewers[1].name, "camera");
  EXPECT_EQ(layout.viewers[1].field.samples, ViewField::Samples::kPixels);
}

TEST_F(SceneLayouts, ViewersMoveWithTheirLinks) {
  const Cycle cycle = TheCycle();
  Layout layout = LoadLayout(path() / "front.yaml", cycle, 0);
  const MachineModel& model = cycle.scenario().machines[0].placement.model;
  cycle.ForEachMoment(5, [&](const Instant& now, const TerrainSurface&) {
    MoveViewers(now.machines[0], &layout);
    const auto expect_at = [&](int viewer, const char* link, const Pose& X_BS) {
      const Pose& X_WB = now.machines[0].links[model.LinkIndex(link)].X_WB;
      EXPECT_TRUE(layout.viewers[viewer].X_WS.isApprox(X_WB * X_BS, 1e-12));
    };
    expect_at(0, "upper", MakePose({0, 0.3, 2.1}, 1 * kDeg, 2 * kDeg, 30 * kDeg));
    expect_at(1, "boom", MakePose({1, 0, 0.4}, 0, 30 * kDeg, 0));
  });
}

TEST_F(SceneLayouts, AViewerIsWhereItTrulyIs) {
  WriteScene("effects: {excavator1: {lidar: {extrinsic: {x_m: 0.2, yaw_deg: 5}}}}");
  const Layout layout = LoadLayout(path() / "front.yaml", TheCycle(), 0);
  // p_BT = p_BS + d and R_BT = R_BS R, as docs/reference/mechanisms.md says.
  EXPECT_TRUE(layout.viewers[0].X_BS.isApprox(
      MakePose({0.2, 0.3, 2.1},
               RotationFromRpy(1 * kDeg, 2 * kDeg, 30 * kDeg) * RotationFromRpy(0, 0, 5 * kDeg)),
      1e-9));
}

TEST_F(SceneLayouts, ARigThatSeesNothingIsRefused) {
  EXPECT_THAT([&] { Load("sensors: [{name: e, preset: tera:config/sensors/encoder.yaml}]\n"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("another.yaml"), HasSubstr("no lidar"))));
  EXPECT_THROW(Load("sensors: [{name: l, preset: tera:config/sensors/vlp16.yaml, link: roof}]\n"),
               InputError);
}

TEST_F(SceneLayouts, ALidarOfOneBeamIsSaidToSeeNothing) {
  const std::string flat =
      "sensors:\n  - {name: scanner, preset: tera:config/sensors/vlp16.yaml, link: upper, "
      "elevation_deg: [0], azimuth_offset_deg: [0], firing_offset_us: [0], xyz_m: [0, 0, 2.5]}\n";
  const Layout layout = Load(flat);
  LayoutStudy study = LoadStudy({});
  study.points = 100;
  const auto report = Evaluate(TheCycle(), study, {layout}, {.threads = 1}).front();
  EXPECT_EQ(MeanOf(*FindFigure(report, {Measure::kSeenBy1, "around"})), 0);
  EXPECT_THAT(report.warnings,
              testing::Contains(AllOf(HasSubstr("scanner"), HasSubstr("one elevation"))));
  EXPECT_TRUE(FlatWarnings(LoadLayout(path() / "front.yaml", TheCycle(), 0)).empty());
}

TEST_F(SceneLayouts, ExpensesAddUp) {
  const Layout layout = LoadLayout(path() / "front.yaml", TheCycle(), 0);
  const Expense expense = ExpenseOf(layout);
  EXPECT_EQ(expense.cost, 4500);
  EXPECT_EQ(expense.power_w, 8.5);
  EXPECT_EQ(expense.sensors, 3);
  EXPECT_EQ(expense.priced, 3);
  EXPECT_EQ(expense.powered, 2);
  // 640 x 480 pixels of three bytes, and 16 x 500 points with all their fields.
  const auto& camera = std::get<CameraModel>(layout.sensors[2].model);
  const double pictures = camera.intrinsics.width_px * camera.intrinsics.height_px * 3.0 *
                          layout.sensors[2].clock.rate_hz;
  const double points = 16 * 500 * 10.0;
  EXPECT_GT(expense.data_mbyteps, (pictures + 12 * points) / 1e6);
  EXPECT_LT(expense.data_mbyteps, (pictures + 40 * points) / 1e6);
}

TEST_F(SceneLayouts, TheStudiedMachineIsFoundByItsName) {
  const Cycle cycle = TheCycle();
  LayoutStudy study = LoadStudy({});
  const MachineModel& model = cycle.scenario().machines[0].placement.model;
  EXPECT_EQ(FindMachine(study, cycle.scenario()).machine, 0u);
  EXPECT_EQ(FindMachine(study, cycle.scenario()).upper, model.LinkIndex("upper"));
  study.upper = "boom";
  EXPECT_EQ(FindMachine(study, cycle.scenario()).upper, model.LinkIndex("boom"));
  study.upper = "roof";
  EXPECT_THAT([&] { FindMachine(study, cycle.scenario()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("roof"), HasSubstr("upper"))));
  study.machine = "mast1";
  study.upper = "";
  EXPECT_EQ(FindMachine(study, cycle.scenario()).machine, 1u);
  study.machine = "crane1";
  EXPECT_THAT([&] { FindMachine(study, cycle.scenario()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("crane1"), HasSubstr("mast1"))));
}

LayoutStudy SmallStudy() {
  LayoutStudy study = LoadStudy({});
  study.points = 300;
  study.person.farthest_m = 6;
  study.map_heights_m = {0.9};
  Zone zone;
  zone.name = "behind";
  zone.frame = "upper";
  zone.X_FZ = MakePose({-4, 0, 0.5});
  zone.shape = ZoneBox{{3, 3, 1}};
  study.zones = {zone};
  return study;
}

TEST_F(SceneLayouts, AreComparedAtTheSameMomentsWithFiguresOfTheSameNames) {
  const Cycle cycle = TheCycle();
  WriteWholeFile(path() / "more.yaml",
                 std::string(kRig) +
                     "  - {name: rear, preset: tera:config/sensors/vlp16.yaml, link: upper, "
                     "xyz_m: [-1.2, 0, 2.6], rpy_deg: [0, 20, 180]}\n");
  const std::vector<Layout> layouts = {LoadLayout(path() / "front.yaml", cycle, 0),
                                       LoadLayout(path() / "more.yaml", cycle, 0)};
  const auto reports = Evaluate(cycle, SmallStudy(), layouts, {.threads = 1});
  const auto again = Evaluate(cycle, SmallStudy(), layouts, {.threads = 2});
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].t_s, reports[1].t_s);
  EXPECT_EQ(reports[0].t_s.size(), 3u);
  ASSERT_EQ(reports[0].figures.size(), reports[1].figures.size());
  std::set<std::string> names;
  for (std::size_t f = 0; f < reports[0].figures.size(); ++f) {
    const Figure &a = reports[0].figures[f], &b = reports[1].figures[f];
    EXPECT_TRUE(names.insert(NameOf(a.id)).second) << NameOf(a.id) << " twice";
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.at.size(), 3u) << NameOf(a.id);
    EXPECT_TRUE(a.error.empty() || a.error.size() == 3u) << NameOf(a.id);
    EXPECT_EQ(a.at, again[0].figures[f].at) << NameOf(a.id) << " depends on threads";
    for (std::size_t m = 0; m < 3; ++m) {
      EXPECT_TRUE(std::isfinite(a.at[m])) << NameOf(a.id);
      EXPECT_TRUE(a.error.empty() || std::isfinite(a.error[m])) << NameOf(a.id);
      // A further sensor reduces nothing, except that it adds cells to an elevation map with larger
      // errors than others.
      if (a.id.measure == Measure::kElevationSigma) continue;
      EXPECT_TRUE(IsMoreBetter(a.id.measure) ? b.at[m] >= a.at[m] : b.at[m] <= a.at[m])
          << NameOf(a.id);
    }
  }
  for (const auto& [zone, causes] : reports[0].blind_causes) {
    double sum = 0;
    for (const auto& [cause, share] : causes) sum += share;
    EXPECT_TRUE(causes.empty() || std::abs(sum - 1) < 1e-9) << zone;
  }
}

TEST_F(SceneLayouts, ReachNoFartherInFogThanItsLight) {
  Layout layout = LoadLayout(path() / "front.yaml", TheCycle(), 0);
  const double clear_m = layout.viewers[0].field.reach_m(0.2);
  PutInAir({}, &layout);
  EXPECT_EQ(layout.viewers[0].field.reach_m(0.2), clear_m);
  PutInAir({.visibility_m = 50}, &layout);
  EXPECT_LT(layout.viewers[0].field.reach_m(0.2), 0.6 * clear_m);
  EXPECT_GT(layout.viewers[0].field.reach_m(0.8), layout.viewers[0].field.reach_m(0.2));
  // 2 % of the contrast are left at the visibility.
  EXPECT_NEAR(layout.viewers[1].field.reach_m(0.2), 50, 1e-9);
}

TEST_F(SceneLayouts, DetectAPersonLessFarInFog) {
  const Cycle cycle = TheCycle();
  LayoutStudy study = SmallStudy();
  const std::vector<Layout> layouts = {LoadLayout(path() / "front.yaml", cycle, 0)};
  const auto within = [&](double visibility_m) {
    study.air.visibility_m = visibility_m;
    const LayoutReport report = Evaluate(cycle, study, layouts, {.threads = 2}).at(0);
    for (const Figure& figure : report.figures) {
      if (NameOf(figure.id) == "person/standing/detected_within_12m") return figure.at.at(0);
    }
    ADD_FAILURE() << "no such figure";
    return 0.0;
  };
  const double clear = within(0), hazy = within(2000), thick = within(8);
  EXPECT_LE(hazy, clear);
  EXPECT_LT(thick, 0.5 * clear);
}

TEST_F(SceneLayouts, WhatTheMachineHidesFromAnEyeIsTheSameForAll) {
  const Cycle cycle = TheCycle();
  LayoutStudy study = SmallStudy();
  study.eye = EyeStudy{.link = "upper", .p_B_m = Vec3(0.1, 0.37, 1.3)};
  study.eye->most_masking_m = 0;
  Layout layout = LoadLayout(path() / "front.yaml", cycle, 0);
  const auto reports = Evaluate(cycle, study, {layout, layout}, {.threads = 1});
  for (const LayoutReport& report : reports) {
    EXPECT_EQ(FindFigure(report, {Measure::kMaskedShare, "circle"})->at.size(), 3u);
    EXPECT_EQ(FindFigure(report, {Measure::kMaskedShare, "circle"})->at,
              FindFigure(reports[0], {Measure::kMaskedShare, "circle"})->at);
    EXPECT_THAT(report.warnings, testing::Contains(HasSubstr("eye: on the circle")));
  }
  study.eye->link = "roof";
  EXPECT_THAT([&] { Evaluate(cycle, study, {layout}, {}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("eye"), HasSubstr("roof"))));
}

TEST_F(SceneLayouts, AZoneOfAnUnknownFrameOrBesideTheSiteIsRefused) {
  const Cycle cycle = TheCycle();
  const Layout layout = LoadLayout(path() / "front.yaml", cycle, 0);
  LayoutStudy study = SmallStudy();
  study.zones[0].frame = "roof";
  EXPECT_THAT([&] { Evaluate(cycle, study, {layout}, {}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("behind"), HasSubstr("roof"))));
  study.zones[0].frame = "W";
  study.zones[0].X_FZ = MakePose({100, 0, 0});
  EXPECT_THAT([&] { Evaluate(cycle, study, {layout}, {}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("behind"), HasSubstr("site"))));
}

}  // namespace
}  // namespace tera
