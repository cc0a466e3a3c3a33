#include "sensors/lidar/scan_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/faults.h"
#include "core/units.h"
#include "render/hand_made_scene.h"
#include "sensors/lidar/lidar_view.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::CubeMesh;
using testing::NoGround;
using testing::OneBodyEach;

ScanPattern Prisms(double first_deg, double second_deg, double first_rpm, double second_rpm) {
  return {.pulses_per_s = 1000,
          .prisms = RisleyPrisms{{first_deg * kDeg, second_deg * kDeg}, {first_rpm, second_rpm}}};
}

double Lean_rad(const Vec3& d_S) { return std::acos(d_S.x()); }

SensorDescription ReadPatternLidar(const std::string& keys) {
  const Config config = Config::FromText(
      "s: {name: l, type: lidar, link: b, rate_hz: 10, max_range_m: 50, " + keys + "}", "rig.yaml");
  SensorDescription sensor = ReadSensor(config.root().Map("s"));
  config.Finish();
  return sensor;
}

/// A file in a folder of its own.
struct PatternFile {
  explicit PatternFile(const std::string& text) {
    path = std::filesystem::path(::testing::TempDir()) /
           (std::string("pattern_") +
            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
    std::ofstream(path) << text;
  }
  ~PatternFile() { std::filesystem::remove(path); }
  std::string Key(double pulses_per_s = 1000) const {
    return "pattern: {pulses_per_s: " + std::to_string(pulses_per_s) + ", csv: '" + path.string() +
           "'}";
  }
  std::filesystem::path path;
};

// Deflections d (cos a, sin a) and d (cos -a, sin -a) add up to 2 d cos a along y.
TEST(ScanPattern, PrismsThatTurnAgainstEachOtherDrawALine) {
  const ScanPattern line = Prisms(10, 10, 60, -60);
  for (const std::uint64_t pulse : {0, 83, 250, 500, 901}) {
    const Vec3 d_S = line.Direction(pulse);
    const double y_rad = 20 * kDeg * std::cos(2 * kPi * static_cast<double>(pulse) / 1000);
    EXPECT_NEAR(d_S.z(), 0, 1e-12);
    EXPECT_NEAR(std::atan2(d_S.y(), d_S.x()), y_rad, 1e-12);
  }
}

TEST(ScanPattern, PrismsThatTurnTogetherDrawACircleAtTheSumOfTheirDeflections) {
  const ScanPattern circle = Prisms(4, 5, 120, 120);
  for (std::uint64_t pulse = 0; pulse < 500; pulse += 7) {
    EXPECT_NEAR(Lean_rad(circle.Direction(pulse)), 9 * kDeg, 1e-9);
  }
  EXPECT_LT((circle.Direction(0) - circle.Direction(500)).norm(), 1e-9);
  // A quarter of a turn after y comes z.
  EXPECT_NEAR(circle.Direction(125).z(), std::sin(9 * kDeg), 1e-9);
}

// One prism that stands turns nothing: the circle of the other stands off the axis.
TEST(ScanPattern, APrismThatStandsShiftsTheCircle) {
  const ScanPattern shifted = Prisms(3, 8, 0, 60);
  EXPECT_NEAR(Lean_rad(shifted.Direction(0)), 11 * kDeg, 1e-9);
  EXPECT_NEAR(Lean_rad(shifted.Direction(500)), 5 * kDeg, 1e-9);
}

TEST(ScanPattern, RowsOfAFileAreItsPulsesOverAndOver) {
  const PatternFile file("time_s,azimuth_deg,elevation_deg\n0,0,0\n0,90,0\n0,0,30\n");
  const auto sensor = ReadPatternLidar(file.Key());
  const ScanPattern& pattern = *std::get<LidarModel>(sensor.model).pattern;
  EXPECT_LT((pattern.Direction(0) - Vec3(1, 0, 0)).norm(), 1e-6);
  EXPECT_LT((pattern.Direction(4) - Vec3(0, 1, 0)).norm(), 1e-6);
  EXPECT_LT((pattern.Direction(302) - Vec3(std::cos(kPi / 6), 0, 0.5)).norm(), 1e-6);
}

TEST(ScanPattern, ZenithsOfLivoxAreCountedFromAbove) {
  const PatternFile file("Time/s,Azimuth/deg,Zenith/deg\n0.00001,180,90\n0.00002,0,97\n");
  const auto sensor = ReadPatternLidar(file.Key());
  const ScanPattern& pattern = *std::get<LidarModel>(sensor.model).pattern;
  EXPECT_LT((pattern.Direction(0) - Vec3(-1, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(pattern.Direction(1).z(), std::sin(-7 * kDeg), 1e-6);
}

TEST(ScanPattern, WhatIsNoPatternIsRefused) {
  const PatternFile empty("azimuth_deg,elevation_deg\n");
  const PatternFile& file = empty;
  EXPECT_THAT([&] { ReadPatternLidar(file.Key()); }, ThrowsFault(kInconsistent, "s.pattern.csv"));
  const std::string prisms = "prisms: {deflection_deg: [9, 9], speed_rpm: [60, -50]}";
  EXPECT_THAT([&] { ReadPatternLidar("pattern: {pulses_per_s: 1000}"); },
              ThrowsFault(kInconsistent, "s.pattern"));
  EXPECT_THAT([&] { ReadPatternLidar("pattern: {pulses_per_s: 4, " + prisms + "}"); },
              ThrowsFault(kInconsistent, "s.pattern"));
  EXPECT_THAT(
      [&] {
        ReadPatternLidar(
            "pattern: {pulses_per_s: 1000, prisms: {deflection_deg: [9], "
            "speed_rpm: [60, -50]}}");
      },
      ThrowsFault(kInconsistent, "s.pattern.prisms"));
  EXPECT_THAT(
      [&] {
        ReadPatternLidar("elevation_deg: [0], pattern: {pulses_per_s: 1000, " + prisms + "}");
      },
      ThrowsFault(kUnknown, "s.elevation_deg"));
}

TEST(ScanPattern, PulsesThatFillNoWholeScanAreRefused) {
  const std::string prisms = "prisms: {deflection_deg: [9, 9], speed_rpm: [60, -50]}";
  EXPECT_THAT([&] { ReadPatternLidar("pattern: {pulses_per_s: 1004, " + prisms + "}"); },
              ThrowsFault(kInconsistent, "s.pattern"));
}

TEST(ScanPattern, AnglesOutsideTheirRangeAreRefused) {
  for (const char* rows : {"0,91\n", "0,0\n400,0\n", "0,-90.5\n"}) {
    const PatternFile file(std::string("azimuth_deg,elevation_deg\n") + rows);
    EXPECT_THAT([&] { ReadPatternLidar(file.Key()); }, ThrowsFault(kOutOfRange, "s.pattern.csv"))
        << rows;
  }
  const PatternFile zenith("Azimuth/deg,Zenith/deg\n0,181\n");
  EXPECT_THAT([&] { ReadPatternLidar(zenith.Key()); }, ThrowsFault(kOutOfRange, "s.pattern.csv"));
}

TEST(ScanPattern, ColumnsThatAFileLacksAreNamed) {
  const PatternFile file("azimuth_deg,tilt\n1,2\n");
  EXPECT_THAT([&] { ReadPatternLidar(file.Key()); }, ThrowsFault(kMissing, "s.pattern.csv"));
}

/// The Mid-40 in the middle of a cube with walls 5 m away.
LidarScan ScanInCube(std::int64_t k, int threads) {
  const Config config = Config::FromText(
      "s: {name: l, link: b, preset: 'tera:config/sensors/livox_mid40.yaml'}", "rig.yaml");
  const SensorDescription sensor = ReadSensor(config.root().Map("s"));
  RayScene scene(OneBodyEach({CubeMesh(5)}));
  scene.Update({{MakePose({0, 0, 0})}}, NoGround());
  PoseTrack X_WS;
  X_WS.Append(0, Pose::Identity());
  return Lidar(std::get<LidarModel>(sensor.model), sensor.clock, 0, 1, "m/l")
      .Measure(k, X_WS, scene, threads);
}

/// Cells of half a degree that a scan's points lie in.
std::set<std::pair<int, int>> CellsOf(const LidarScan& scan) {
  std::set<std::pair<int, int>> cells;
  for (const LidarPoint& p : scan.points) {
    cells.emplace(std::lround(std::atan2(p.y_m, p.x_m) / kDeg * 2),
                  std::lround(std::atan2(p.z_m, p.x_m) / kDeg * 2));
  }
  return cells;
}

// The manual's field is a circle of 38.4 deg. The pattern does not repeat, so that half a second
// covers more of it than its first tenth.
TEST(ScanPattern, TheMid40FillsItsFieldWithTime) {
  std::set<std::pair<int, int>> seen;
  std::size_t first = 0;
  for (int k = 0; k < 5; ++k) {
    const LidarScan scan = ScanInCube(k, 1);
    ASSERT_EQ(scan.points.size(), 10'000u);
    EXPECT_EQ(scan.points[1].time_offset_ns, 10'000u);
    for (const LidarPoint& p : scan.points) {
      const double lean_rad = std::atan2(std::hypot(p.y_m, p.z_m), p.x_m);
      ASSERT_LE(lean_rad, 19.2 * kDeg + 1e-4);
    }
    seen.merge(CellsOf(scan));
    if (k == 0) first = seen.size();
  }
  const double in_field = kPi * std::pow(19.2 * 2, 2);
  EXPECT_LT(static_cast<double>(first), 0.75 * in_field);
  EXPECT_GT(static_cast<double>(seen.size()), 1.3 * static_cast<double>(first));
}

TEST(ScanPattern, ScansDoNotDependOnTheNumberOfThreads) {
  const LidarScan one = ScanInCube(3, 1), four = ScanInCube(3, 4);
  ASSERT_EQ(one.points.size(), four.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    ASSERT_EQ(std::memcmp(&one.points[i], &four.points[i], offsetof(LidarPoint, label) + 1), 0);
  }
}

// A line in the horizontal plane at y = 20 deg cos(a): half of the pulses lie beyond 14.1 deg on
// either side, none above or below.
TEST(ScanPattern, ItsViewIsDensestWhereALineTurns) {
  LidarModel model;
  model.elevation_rad = {0};
  model.pattern = Prisms(10, 10, 61, -61);
  model.columns = 100;
  const ViewField view = ViewOf(model, 10);
  // Above and below the horizon, which borders two rows of cells.
  const auto at = [&](double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * kDeg, e = elevation_deg * kDeg;
    const Vec3 level(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), 0);
    return view.per_steradian(level + std::sin(e) * Vec3::UnitZ()) +
           view.per_steradian(level - std::sin(e) * Vec3::UnitZ());
  };
  // The share of the angle a in which the line crosses 2 deg of azimuth, at its turn and its
  // middle.
  const double turn = std::acos(18 / 20.0), middle = std::asin(2 / 20.0);
  EXPECT_NEAR(at(19, 0.1) / at(1, 0.1), turn / middle, 0.03 * turn / middle);
  EXPECT_NEAR(at(-19, 0.1), at(19, 0.1), 0.02 * at(19, 0.1));
  EXPECT_EQ(at(0, 19) + at(23, 0.1), 0);
}

// All pulses of a scan, over the sphere in the cells in which the density is constant.
TEST(ScanPattern, ItsViewHasAllPulsesOfAScan) {
  LidarModel model;
  model.elevation_rad = {0};
  model.pattern = Prisms(9.6, 9.6, 7294, -4664);
  model.columns = 10'000;
  const ViewField view = ViewOf(model, 10);
  EXPECT_FALSE(view.is_flat);
  double sum = 0;
  constexpr int kRows = 90, kTurns = 180;
  for (int row = 0; row < kRows; ++row) {
    const double z = -1 + 2 * (row + 0.5) / kRows;
    for (int turn = 0; turn < kTurns; ++turn) {
      const double azimuth = -kPi + 2 * kPi * (turn + 0.5) / kTurns;
      const double level = std::sqrt(1 - z * z);
      sum += view.per_steradian({level * std::cos(azimuth), level * std::sin(azimuth), z});
    }
  }
  EXPECT_NEAR(sum * 4 * kPi / (kRows * kTurns), 10'000, 1);
  EXPECT_EQ(view.per_steradian(-Vec3::UnitX()), 0);
}

}  // namespace
}  // namespace tera
