#include "layout/measures/people.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "layout/looked_at_site.h"
#include "layout/sight/hull.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera_view.h"
#include "sensors/lidar/lidar_view.h"

// Distances of detection of a person, against scans and pictures of a box of this size.

namespace tera {
namespace {

const Posture kStanding = {.name = "standing", .size_m = Vec3(0.3, 0.5, 1.75)};
const Posture kLying = {.name = "lying", .size_m = Vec3(0.5, 1.75, 0.3)};

std::vector<double> HullOf(const LookedAtSite& site) {
  return HullRadii_m(X_WH(), 0, PersonRange::kSectors, site.sighting());
}

/// The person's place in a direction: facing the machine, with the middle on the ground at P.
Pose PersonAt(int sector, double distance_m) {
  const Pose X_HP = MakePose(Vec3::Zero(), 0, 0, sector * 10 * kDeg) * MakePose({distance_m, 0, 0});
  return X_WH() * X_HP;
}

/// A box of this size about the origin.
Mesh BoxMesh(const Vec3& size_m) {
  Mesh mesh = testing::CubeMesh(0.5);
  for (auto& p : mesh.parts[0].positions_m) p = p.cwiseProduct(size_m.cast<float>());
  return mesh;
}

/// Whether the person is detected at this distance in a direction, the farthest tested.
bool IsDetected(const LookedAtSite& site, const Posture& posture, const Layout& layout,
                double needed, int sector, double distance_m) {
  PersonStudy study;
  study.lidar_points = study.camera_px = needed;
  study.farthest_m = distance_m;
  PersonRange range(posture, study, 0.2);
  range.Add(X_WH(), HullOf(site), layout, site.sighting(), site.ground());
  return range.Curve().mean.at(static_cast<std::size_t>(2 * sector)) >= distance_m;
}

/// The largest number of points or pixels that is still expected on the person, by bisection.
double Expected(const LookedAtSite& site, const Posture& posture, const Layout& layout, int sector,
                double distance_m) {
  double low = 0, high = 1e5;
  EXPECT_FALSE(IsDetected(site, posture, layout, high, sector, distance_m));
  while (high - low > 1e-3 * high + 1e-6) {
    const double middle = low == 0 ? 0.1 * high : std::sqrt(low * high);
    (IsDetected(site, posture, layout, middle, sector, distance_m) ? low : high) = middle;
  }
  return low;
}

/// A lidar with fine even steps from 20 deg up to 60 deg down.
LidarModel FineLidar() {
  LidarModel model;
  for (int b = 0; b < 320; ++b) model.elevation_rad.push_back((20 - 0.25 * b) * kDeg);
  model.azimuth_offset_rad.assign(320, 0);
  model.firing_offset_s.assign(320, 0);
  model.columns = 1024;
  model.min_range_m = 0.1;
  return model;
}

struct Scanned {
  Posture posture;
  int sector;
  double distance_m;
};
const Scanned kScanned[] = {
    {kStanding, 0, 6}, {kStanding, 9, 4}, {kStanding, 22, 8}, {kLying, 31, 5}};

/// Points of a scan on a box of the person's size.
double PointsOnBox(const LidarModel& model, const Pose& X_WS, const Scanned& where) {
  RayScene scene(testing::OneBodyEach({BoxMesh(where.posture.size_m)}));
  const Pose X_WBox =
      PersonAt(where.sector, where.distance_m) * MakePose({0, 0, 0.5 * where.posture.size_m.z()});
  scene.Update({{X_WBox}}, testing::NoGround());
  PoseTrack track;
  track.Append(0, X_WS);
  return static_cast<double>(
      Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1).points.size());
}

TEST(PersonRange, ExpectsAsManyPointsAsAScanHas) {
  // A scan has whole rows and columns on the box. Over attitudes by fractions of a step, their
  // number is random, off by at most half of one of some tens each, which four attitudes halve. 5 %
  // cover that and the error of the solid angle by eight patches a side.
  const LookedAtSite site({});
  const LidarModel model = FineLidar();
  for (const Scanned& where : kScanned) {
    double scanned = 0, expected = 0;
    for (int k = 0; k < 4; ++k) {
      Viewer viewer = ViewerAt("lidar", {0.2, -0.1, 2.4}, ViewOf(model, 10));
      viewer.X_WS = viewer.X_WS * MakePose(Vec3::Zero(), 0.02, 0.01 + 0.0011 * k, 0.3 + 0.0015 * k);
      scanned += PointsOnBox(model, viewer.X_WS, where);
      expected += Expected(site, where.posture, LayoutOf({viewer}), where.sector, where.distance_m);
    }
    EXPECT_GT(scanned, 400);
    EXPECT_NEAR(expected, scanned, 0.05 * scanned + 3 * std::sqrt(scanned) / 4)
        << where.posture.name << ", " << where.distance_m << " m";
  }
}

TEST(PersonRange, ExpectsAsManyPixelsAsAPictureHas) {
  CameraModel model;
  model.intrinsics = {.width_px = 320,
                      .height_px = 240,
                      .fx_px = 200,
                      .fy_px = 200,
                      .cx_px = 160,
                      .cy_px = 120,
                      .k1 = -0.15,
                      .k2 = 0.03};
  const LookedAtSite site({});
  for (const Scanned& where : kScanned) {
    const Vec3 size_m = where.posture.size_m;
    const Pose X_WBox =
        PersonAt(where.sector, where.distance_m) * MakePose({0, 0, 0.5 * size_m.z()});
    // Looks near the person, not straight at her, and down to a person lying a metre away.
    const double down_deg = size_m.z() < 1 ? 40 : 25;
    Viewer viewer = ViewerAt("camera", {0.2, -0.1, 2.4}, ViewOf(model, 10));
    viewer.X_WS = viewer.X_WS * MakePose(Vec3::Zero(), 0, 0, (where.sector * 10 + 8) * kDeg) *
                  MakePose(Vec3::Zero(), 0.05, down_deg * kDeg, 0);
    const SceneModel scene(testing::OneBodyEach({BoxMesh(size_m)}));
    const TerrainSurface ground =
        testing::Ground(81, 81, 1, -40, [](double, double) { return 0.0; });
    Rasterizer rasterizer(scene, {});
    SceneState state;
    state.X_WB = {X_WBox};
    state.terrain = &ground;
    const CameraFrame frame = Camera(model, {.rate_hz = 10}, 0, 1, "m/camera")
                                  .Measure(0, viewer.X_WS, state, &rasterizer);
    const auto pixels =
        static_cast<double>(std::count(frame.instance.data.begin(), frame.instance.data.end(), 1));
    EXPECT_GT(pixels, 300);
    double low = 0;
    for (double needed = 0.8 * pixels; needed < 1.2 * pixels; needed += 0.01 * pixels) {
      PersonStudy study;
      study.camera_px = needed;
      study.farthest_m = where.distance_m;
      PersonRange range(where.posture, study, 0.2);
      range.Add(X_WH(), HullOf(site), LayoutOf({viewer}), site.sighting(), site.ground());
      if (range.Curve().mean.at(static_cast<std::size_t>(2 * where.sector)) >= where.distance_m) {
        low = needed;
      }
    }
    EXPECT_NEAR(low, pixels, 0.05 * pixels + 3 * std::sqrt(pixels) / 4)
        << where.posture.name << ", " << where.distance_m << " m";
  }
}

TEST(PersonRange, OfHerOnlyWhatIsInSightCounts) {
  // Over the edge of a wall a metre before the person, a lidar sees the upper half: from (0, 0,
  // 2.4) over the middle of the front, at 5.85 m and 0.875 m.
  const double edge_m = 2.4 - (2.4 - 0.875) * 5 / 5.85;
  const LookedAtSite site({.boxes = {{"wall1", {5, -3, 0}, {5.001, 3, edge_m}}}});
  const LidarModel model = FineLidar();
  RayScene scene(testing::OneBodyEach({BoxMesh(kStanding.size_m), BoxMesh({0.001, 6, edge_m})}));
  scene.Update(
      {{PersonAt(0, 6) * MakePose({0, 0, 0.875}), X_WH() * MakePose({5.0005, 0, 0.5 * edge_m})}},
      testing::NoGround());
  const Viewer viewer = ViewerAt("lidar", {0, 0, 2.4}, ViewOf(model, 10));
  PoseTrack track;
  track.Append(0, viewer.X_WS);
  double scanned = 0;
  for (const LidarPoint& p :
       Lidar(model, {.rate_hz = 10}, 0, 1, "m/lidar").Measure(0, track, scene, 1).points) {
    scanned += p.instance == 1;
  }
  EXPECT_GT(scanned, 100);
  const double expected = Expected(site, kStanding, LayoutOf({viewer}), 0, 6);
  EXPECT_NEAR(expected, scanned, 0.05 * scanned + 3 * std::sqrt(scanned) / 2);
}

/// A lidar with unlimited density, and this reach on a face-on target of 10 %.
ViewField ReachingField(double at_10_percent_m) {
  ViewField field = EverywhereAlike();
  field.reach_m = [=](double returned) { return at_10_percent_m * std::sqrt(returned / 0.1); };
  return field;
}

PersonRange RangeOf(const LookedAtSite& site, const Layout& layout, double reflectance = 0.1,
                    const PersonStudy& study = {}) {
  PersonRange range(kStanding, study, reflectance);
  range.Add(X_WH(), HullOf(site), layout, site.sighting(), site.ground());
  return range;
}

TEST(PersonRange, EndsWhereALidarReachesNoFarther) {
  // The front is 0.15 m nearer than the middle. At the height of the middle the incidence is at
  // most asin(0.875 / 5.85), so that the reach of 6 m is at least 5.96 m.
  const LookedAtSite site({});
  const Layout layout = LayoutOf({ViewerAt("lidar", {0, 0, 0.9}, ReachingField(6))});
  for (const auto& [reflectance, reached_m] : {std::pair{0.1, 6.0}, {0.4, 12.0}, {1.6, 24.0}}) {
    const PersonRange range = RangeOf(site, layout, reflectance);
    EXPECT_THAT(range.Curve().mean, ::testing::Each(reached_m));
  }
}

TEST(PersonRange, DistancesCountFromTheHullOfTheMachine) {
  // A machine 1.5 m long ahead, 1 m behind and 0.8 m wide on either side, with a lidar on a pole
  // above it. The person's front at d is d + 1.5 - 0.15 m ahead. The range to the upper parts, from
  // 0.87 m on, is within sqrt((d + 1.35)^2 + 1.3^2): 5.51 m at 4 m. To all parts it exceeds 6.3 m
  // at 5 m.
  const LookedAtSite site({.parts = {{"undercarriage", {-1, -0.8, 0.1}, {1.5, 0.8, 1}}}});
  const Layout layout = LayoutOf({ViewerAt("lidar", {0, 0, 2.2}, ReachingField(6.1))});
  const PersonRange range = RangeOf(site, layout);
  EXPECT_EQ(range.Curve().mean.at(0), 4);
  // Behind, 1 m: at 5 m the front is at 5.85 m, and the range to its top below 5.9 m; at 6 m it is
  // not.
  EXPECT_EQ(range.Curve().mean.at(36), 5);
  // To the left, 0.8 m: 5.65 m at 5 m, 6.65 m at 6 m.
  EXPECT_EQ(range.Curve().mean.at(18), 5);
}

TEST(PersonRange, AWallEndsItInItsDirectionAlone) {
  const LookedAtSite site({.boxes = {{"wall1", {4.5, -0.6, 0}, {4.6, 0.6, 4}}}});
  const PersonRange range =
      RangeOf(site, LayoutOf({ViewerAt("lidar", {0, 0, 2}, ReachingField(99))}));
  EXPECT_EQ(range.Distances_m().size(), 24u);
  EXPECT_EQ(range.Curve().mean.at(0), 4);
  EXPECT_EQ(range.Curve().mean.at(18), 24);
  const auto figures = range.Figures();
  const auto at = [&](const std::string& name) {
    return FigureOf(figures, "person/standing/" + name).at.at(0);
  };
  EXPECT_EQ(at("detected_to_m_ahead"), 4);
  EXPECT_EQ(at("detected_to_m_left"), 24);
  EXPECT_EQ(at("detected_to_m_behind"), 24);
  EXPECT_EQ(at("detected_to_m_right"), 24);
  // Among 72 x 12 places, those at 5 to 12 m in three directions are hidden. The wall spans 7.6 deg
  // to either side. The facing side of a person 5 deg aside extends 0.125 m to either side, 1.4 deg
  // at 5 m.
  EXPECT_NEAR(at("detected_within_12m"), 1 - 3 * 8.0 / (72 * 12), 1e-9);
}

TEST(PersonRange, WithoutAViewerSheIsDetectedNowhere) {
  const LookedAtSite site({});
  const PersonRange range = RangeOf(site, LayoutOf({}));
  EXPECT_THAT(range.Curve().mean, ::testing::Each(0));
  for (const Figure& figure : range.Figures()) {
    // A metre beyond the farthest tested distance.
    const bool is_nearest = figure.id.measure == Measure::kDetectedFrom;
    EXPECT_EQ(figure.at.at(0), is_nearest ? 25 : 0) << NameOf(figure.id);
  }
}

TEST(PersonRange, FromWhereOnSheIsDetectedIsToldToo) {
  // A lidar 4.5 m up that looks down by less than acos(0.9) = 25.8 deg sees the person's top, 1.75
  // m above the ground, from (4.5 - 1.75) / tan(25.8 deg) = 5.7 m on, hence at 6 m.
  const LookedAtSite site({});
  ViewField field = ReachingField(99);
  field.per_steradian = [](const Vec3& d) { return d.head<2>().norm() > 0.9 ? 1e9 : 0.0; };
  const PersonRange range = RangeOf(site, LayoutOf({ViewerAt("lidar", {0, 0, 4.5}, field)}));
  const auto figures = range.Figures();
  EXPECT_EQ(FigureOf(figures, "person/standing/detected_from_m_behind").at.at(0), 6);
  EXPECT_EQ(FigureOf(figures, "person/standing/detected_over_m_behind").at.at(0), 19);
  EXPECT_EQ(FigureOf(figures, "person/standing/detected_to_m_behind").at.at(0), 24);
  const PolarCurve curve = range.Curve();
  EXPECT_THAT(curve.worst_from, ::testing::Each(6));
  EXPECT_THAT(curve.worst, ::testing::Each(24));
  const PolarMap map = range.Maps().at(0);
  EXPECT_EQ(NameOf(map.id), "detected/standing");
  EXPECT_EQ(map.value.at(4), 0);  // ahead, 5 m
  EXPECT_EQ(map.value.at(5), 1);
}

TEST(PersonRange, AGapIsMissingFromTheMetresAtWhichSheIsDetected) {
  // A fence of 3 m, 5.3 m ahead, hides a person from a lidar 4.5 m up until the top, 1.75 m above
  // the ground, is visible above it. The person is visible from 5.3 (4.5 - 1.75) / (4.5 - 3) = 9.7
  // m on, so that detection fails at 6, 7, 8 and 9 m.
  const LookedAtSite site({.boxes = {{"fence1", {5.3, -9, 0}, {5.31, 9, 3}}}});
  const PersonRange range =
      RangeOf(site, LayoutOf({ViewerAt("lidar", {0, 0, 4.5}, ReachingField(99))}));
  const PolarMap map = range.Maps().at(0);
  for (int at_m = 1; at_m <= 24; ++at_m) {
    EXPECT_EQ(map.value.at(static_cast<std::size_t>(at_m - 1)), at_m < 6 || at_m > 9) << at_m;
  }
  EXPECT_EQ(range.Curve().worst_from.at(0), 1);
  EXPECT_EQ(range.Curve().worst.at(0), 24);
  // Among the quarter's directions, 45 deg aside hides the person up to 9.7 m / cos(45 deg) = 13.7
  // m.
  EXPECT_EQ(FigureOf(range.Figures(), "person/standing/detected_over_m_ahead").at.at(0), 24 - 8);
}

TEST(PersonRange, OfAQuarterTheDistancesAtWhichAllItsDirectionsDetectHerCount) {
  // Left of straight ahead it sees from 1 to 6 m, right of it from 3 m on.
  const LookedAtSite site({});
  const auto ranging = [](const std::string& name, double from_m, double to_m, int side) {
    ViewField field = EverywhereAlike();
    field.per_steradian = [=](const Vec3& d) { return side * (d.y() + 1e-9) >= 0 ? 1e9 : 0.0; };
    field.nearest_m = from_m;
    field.reach_m = [=](double) { return to_m; };
    return ViewerAt(name, {0, 0, 0.9}, field);
  };
  const Layout layout = LayoutOf({ranging("left", 0, 6.2, 1), ranging("right", 2.6, 99, -1)});
  const auto figures = RangeOf(site, layout).Figures();
  const auto at = [&](const std::string& name) {
    return FigureOf(figures, "person/standing/" + name).at.at(0);
  };
  EXPECT_EQ(at("detected_from_m_left"), 1);
  EXPECT_EQ(at("detected_to_m_left"), 6);
  EXPECT_EQ(at("detected_from_m_right"), 3);
  EXPECT_EQ(at("detected_to_m_right"), 24);
  EXPECT_EQ(at("detected_from_m_ahead"), 3);
  EXPECT_EQ(at("detected_to_m_ahead"), 6);
  EXPECT_EQ(at("detected_over_m_ahead"), 4);
}

}  // namespace
}  // namespace tera
