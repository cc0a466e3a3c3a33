#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "app/refused.h"
#include "core/faults.h"
#include "core/units.h"
#include "survey/survey_files.h"
#include "survey/surveyed_yard.h"

// `tera site` and `tera register` from a user's view.

namespace tera {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;
using testing_survey::kBoxes;
using testing_survey::LasOf;
using testing_survey::PlyOf;
using testing_survey::WriteBytes;
namespace fs = std::filesystem;

/// Place of the yard's south-western corner in UTM zone 32N.
const Vec3 kMap_m(600'000, 5'250'000, 420);

json JsonOf(const fs::path& file) { return json::parse(ReadWholeFile(file)); }

class SurveyCommands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchDirectory>();
    std::vector<Vec3> on_map_m;
    for (const Vec3& p : testing_survey::YardScanner(5).Scan(0.2)) on_map_m.push_back(p + kMap_m);
    WriteBytes(scratch_->path() / "yard.las", LasOf(on_map_m, kMap_m, 32632));
    made_ = RunTera({"site", "yard.las", "--out", "site"}, {scratch_->path()});
    ASSERT_EQ(made_.status, 0) << made_.err;
  }
  static void TearDownTestSuite() { scratch_.reset(); }

  static fs::path File(const std::string& name) { return scratch_->path() / name; }

  static std::unique_ptr<ScratchDirectory> scratch_;
  static Outcome made_;
};

std::unique_ptr<ScratchDirectory> SurveyCommands::scratch_;
Outcome SurveyCommands::made_;

TEST_F(SurveyCommands, ASiteSaysWhatItIsMadeOf) {
  EXPECT_THAT(made_.out, AllOf(HasSubstr("map: WGS 84 / UTM zone 32N"), HasSubstr("things: 4"),
                               HasSubstr("cells of 0.2 m"), HasSubstr("scenario: site/site.yaml")));
  for (const char* name : {"terrain.tif", "mask.tif", "site.yaml", "site.json",
                           "things/thing_001.obj", "things/thing_004.obj"}) {
    EXPECT_TRUE(fs::exists(File("site") / name)) << name;
  }
}

TEST_F(SurveyCommands, TheScenarioIsReadAndStandsOnTheEarthWhereTheSurveyDoes) {
  const Outcome check = RunTera({"check", "site/site.yaml"}, {scratch_->path()});
  EXPECT_EQ(check.status, 0) << check.err;
  const json report = JsonOf(File("site/site.json"));
  // Easting 600 020, northing 5 250 015 of zone 32 by GeographicLib's GeoConvert -g.
  EXPECT_NEAR(report["origin"]["lat_deg"].get<double>(), 47.39593, 1e-5);
  EXPECT_NEAR(report["origin"]["lon_deg"].get<double>(), 10.32544, 1e-5);
  EXPECT_NEAR(report["origin"]["height_m"].get<double>(), 420 + 0.05 * 20, 0.1);
}

// North of the map is rotated against true north by the difference of longitude from the zone's
// meridian (9 deg) times the sine of the latitude. Its scale on the ellipsoid is 0.9996 times 1 +
// (100 km)^2 / 2R^2.
TEST_F(SurveyCommands, ThingsAreTurnedFromTheMapsNorthToTrueNorth) {
  const json report = JsonOf(File("site/site.json"));
  const double turn_rad = (10.3254 - 9) * std::sin(47.3959 * kDeg) * kDeg;
  const double scale = 0.9996 * (1 + 0.5 * std::pow(100'020 / 6.38e6, 2));
  ASSERT_EQ(report["things"].size(), kBoxes.size());
  const double cell_m = report["terrain"]["cell_m"];
  // The middle of the raster, which covers whole cells about the yard.
  const Vec2 size_m(report["terrain"]["columns"].get<int>() * cell_m,
                    report["terrain"]["rows"].get<int>() * cell_m);
  EXPECT_LT((size_m - Vec2(40, 30)).cwiseAbs().maxCoeff(), 0.5);
  const Eigen::Rotation2Dd turn(-turn_rad);
  for (std::size_t k = 1; k < kBoxes.size(); ++k) {
    const auto place = [&](std::size_t thing) {
      const json& xy = report["things"][thing]["xy_W_m"];
      return Vec2(xy[0].get<double>(), xy[1].get<double>());
    };
    const Vec2 expected = turn * (kBoxes[k].at_m - kBoxes[0].at_m) / scale;
    EXPECT_LT((place(k) - place(0) - expected).norm(), 0.08) << k;
  }
  const double yaw_deg = report["things"][0]["yaw_deg"];
  EXPECT_NEAR(yaw_deg, (kBoxes[0].yaw_rad - turn_rad) / kDeg, 1.0);
  EXPECT_GT(std::abs(turn_rad / kDeg), 0.9);
}

TEST_F(SurveyCommands, AScanIsRegisteredWithTheSurveyAndLessWithItsTerrain) {
  // A view of the yard from a scanner in its own frame.
  const Pose X_MS = MakePose(kMap_m + Vec3(20, 14, 3), 0, 0, 25 * kDeg);
  std::vector<Vec3> scan_m;
  for (const Vec3& p : testing_survey::YardScanner(6).Scan(0.2)) {
    const Vec3 p_S = X_MS.inverse() * (p + kMap_m);
    if (p_S.norm() < 12) scan_m.push_back(p_S);
  }
  WriteBytes(File("scan.ply"), PlyOf(scan_m));
  const auto registered = [&](const std::string& with) {
    return RunTera({"register", with, "scan.ply", "--start", "600020.3", "5250013.8", "423.1", "0",
                    "0", "24", "--json", "pose.json"},
                   {scratch_->path()});
  };
  const Outcome found = registered("yard.las");
  EXPECT_EQ(found.status, 0) << found.out << found.err;
  EXPECT_THAT(found.out, HasSubstr("status: registered"));
  const json pose = JsonOf(File("pose.json"));
  EXPECT_EQ(pose["status"], "registered");
  EXPECT_EQ(pose["covariance"].size(), 6u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(pose["X_AB"]["xyz_m"][static_cast<std::size_t>(axis)].get<double>(),
                X_MS.translation()[axis], 0.01);
  }
  EXPECT_NEAR(pose["X_AB"]["rpy_deg"][2].get<double>(), 25, 0.1);

  // The ground reduces to a plane and a cone, about whose axis it may rotate.
  const Outcome less = registered("site/terrain.tif");
  EXPECT_EQ(less.status, 5) << less.out << less.err;
  const json motions = JsonOf(File("pose.json"))["open_motions"];
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0]["kind"], "turn");
  EXPECT_NEAR(std::abs(motions[0]["along"][2].get<double>()), 1, 0.02);
  const Vec2 pile_m = kMap_m.head<2>() + testing_survey::kPile_m;
  EXPECT_NEAR(motions[0]["through_A_m"][0].get<double>(), pile_m.x(), 0.5);
  EXPECT_NEAR(motions[0]["through_A_m"][1].get<double>(), pile_m.y(), 0.5);
}

TEST_F(SurveyCommands, WhatCannotBeRegisteredEndsWithAStatusOfItsOwn) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-8, 8);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<Vec3> floor_m, far_m;
  for (int k = 0; k < 5000; ++k) {
    floor_m.emplace_back(place(random), place(random), noise(random));
    far_m.emplace_back(floor_m.back() + Vec3(100, 0, 0));
  }
  WriteBytes(File("floor.ply"), PlyOf(floor_m));
  WriteBytes(File("far.ply"), PlyOf(far_m));
  const Outcome open =
      RunTera({"register", "floor.ply", "floor.ply", "--json", "open.json"}, {scratch_->path()});
  EXPECT_EQ(open.status, 5);
  EXPECT_THAT(open.out, HasSubstr("not observed by the geometry: x, y, yaw"));
  EXPECT_THAT(open.out, ContainsRegex("1 sigma: x not observed y not observed z 0.0[0-9]+ m, about "
                                      "x 0.0[0-9]+ y 0.0[0-9]+ z not observed deg"));
  const json result = JsonOf(File("open.json"));
  EXPECT_EQ(result["open_axes"], json({"x", "y", "yaw"}));
  EXPECT_EQ(result["centre_not_observed"], json({"x", "y", "yaw"}));
  const Outcome apart = RunTera({"register", "floor.ply", "far.ply"}, {scratch_->path()});
  EXPECT_EQ(apart.status, 3);
  EXPECT_THAT(apart.out, HasSubstr("status: no_overlap"));
}

TEST(SurveyInput, ThatCannotBeUsedLeavesNothingBehind) {
  const ScratchDirectory scratch;
  const auto refuse = [&](const std::string& name, const std::string& bytes,
                          const testing::Matcher<const std::string&>& message) {
    WriteBytes(scratch.path() / name, bytes);
    ExpectRefused(scratch, {"site", name, "--out", "site"}, message);
    ExpectRefused(scratch, {"register", name, name, "--json", "pose.json"}, message);
  };
  refuse("notes.las", "easting northing\n1 2\n",
         StartsWith("notes.las: does not begin with 'LASF'"));
  refuse("notes.txt", "1 2 3\n", HasSubstr("need .pcd, .ply, .las or .tif"));
  refuse("packed.laz", "LASF", HasSubstr("LAZ is compressed"));
  refuse("text.tif", "no raster", StartsWith("text.tif: not readable as a GeoTIFF"));
  refuse("none.ply", PlyOf({}), HasSubstr("no point is usable"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse("nan.ply", PlyOf({{nan, 0, 0}, {0, nan, 0}}), HasSubstr("2 without finite coordinates"));
  const std::string whole = PlyOf({{0, 0, 0}, {1, 1, 1}});
  refuse("cut.ply", whole.substr(0, whole.size() - 9), HasSubstr("cut.ply: cut off"));
  ExpectRefused(scratch, {"site", "gone.las", "--out", "site"}, HasSubstr("gone.las"));
}

/// A yard of 12 x 9 m that rises by a fifth to the east, with a point in each 0.1 m.
std::vector<Vec3> SmallYard(const Vec3& low_m) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Vec3> p_m;
  for (int k = 0; k < 10'800; ++k) {
    const Vec2 at_m(0.1 * (k % 120 + part(random)), 0.1 * (k / 120 + part(random)));
    p_m.push_back(low_m + Vec3(at_m.x(), at_m.y(), 0.2 * at_m.x()));
  }
  return p_m;
}

TEST(SurveyWithoutAMap, FarFromItsOriginIsAskedFor) {
  const ScratchDirectory scratch;
  for (const Vec3& low_m : {kMap_m, Vec3(2'600'000, 1'200'000, 550), Vec3(10'000, 50'000, 100)}) {
    WriteBytes(scratch.path() / "yard.ply", PlyOf(SmallYard(low_m)));
    ExpectRefused(scratch, {"site", "yard.ply", "--out", "site"},
                  AllOf(TellsOf("yard.ply"), HasSubstr("--local")));
  }
  std::vector<Vec3> mm = SmallYard(Vec3::Zero());
  for (Vec3& p : mm) p *= 1000;
  WriteBytes(scratch.path() / "mm.ply", PlyOf(mm));
  ExpectRefused(scratch, {"site", "mm.ply", "--out", "site"},
                HasSubstr("convert millimetres to metres"));
}

// The middle is 6 m to the east and 1.2 m above the corner.
TEST(SurveyWithoutAMap, LiesOnItsMapOrAboutItsMiddleWithItsOwnHeights) {
  const ScratchDirectory scratch;
  WriteBytes(scratch.path() / "yard.ply", PlyOf(SmallYard(kMap_m)));
  const Outcome on_map =
      RunTera({"site", "yard.ply", "--out", "map", "--map", "EPSG:32632"}, {scratch.path()});
  EXPECT_EQ(on_map.status, 0) << on_map.err;
  const json place = JsonOf(scratch.path() / "map/site.json")["origin"];
  // Easting 600 006, northing 5 250 004.5 of zone 32 by GeographicLib's GeoConvert -g.
  EXPECT_NEAR(place["lat_deg"].get<double>(), 47.39584, 1e-5);
  EXPECT_NEAR(place["lon_deg"].get<double>(), 10.32525, 1e-5);
  EXPECT_NEAR(place["height_m"].get<double>(), 421.2, 0.05);

  const Outcome local =
      RunTera({"site", "yard.ply", "--out", "local", "--local"}, {scratch.path()});
  EXPECT_EQ(local.status, 0) << local.err;
  EXPECT_THAT(local.out, HasSubstr("map: none; x 600006."));
  const json own = JsonOf(scratch.path() / "local/site.json");
  EXPECT_NEAR(own["origin"]["height_m"].get<double>(), 421.2, 0.05);
  EXPECT_NEAR(own["origin"]["lat_deg"].get<double>(), 47.3763, 1e-5);
  EXPECT_NEAR(own["middle_m"][0].get<double>(), 600'006, 0.1);
  EXPECT_NEAR(own["middle_m"][1].get<double>(), 5'250'004.5, 0.1);

  const Outcome placed =
      RunTera({"site", "yard.ply", "--out", "placed", "--local", "--origin", "52", "13", "-400"},
              {scratch.path()});
  EXPECT_EQ(placed.status, 0) << placed.err;
  const json there = JsonOf(scratch.path() / "placed/site.json")["origin"];
  EXPECT_NEAR(there["lat_deg"].get<double>(), 52, 1e-5);
  EXPECT_NEAR(there["height_m"].get<double>(), 21.2, 0.05);
}

TEST(SurveyInput, OfTooFewDigitsIsRefusedAndTakenForCellsAsCoarse) {
  const ScratchDirectory scratch;
  std::vector<Vec3> single = SmallYard(kMap_m);
  for (Vec3& p : single) p = p.cast<float>().cast<double>();
  WriteBytes(scratch.path() / "single.ply", PlyOf(single));
  const auto finding = TellsOf("single.ply");
  ExpectRefused(scratch, {"site", "single.ply", "--out", "site", "--map", "EPSG:32632"}, finding);
  ExpectRefused(scratch, {"register", "single.ply", "single.ply", "--json", "pose.json"}, finding);
  const Outcome coarse =
      RunTera({"site", "single.ply", "--out", "coarse", "--map", "EPSG:32632", "--cell", "0.5"},
              {scratch.path()});
  EXPECT_EQ(coarse.status, 0) << coarse.err;
  EXPECT_THAT(coarse.out, HasSubstr("warning: single.ply: y has steps of 0.5 m"));
}

TEST(SurveyInput, ThatDoesNotFitASiteIsRefusedWithWhatToDo) {
  const ScratchDirectory scratch;
  std::vector<Vec3> wide_m, coarse_m;
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 40; ++i) {
      wide_m.emplace_back(250.0 * i, 250.0 * j, 0);
      coarse_m.emplace_back(0.5 * i, 0.5 * j, 0.01 * ((i * 7 + j * 3) % 5));
    }
  }
  WriteBytes(scratch.path() / "wide.ply", PlyOf(wide_m));
  WriteBytes(scratch.path() / "coarse.ply", PlyOf(coarse_m));
  WriteBytes(scratch.path() / "feet.las", LasOf(coarse_m, Vec3::Zero(), 2263));
  WriteBytes(scratch.path() / "degrees.las", LasOf(coarse_m, Vec3::Zero(), 4326));
  WriteBytes(scratch.path() / "map.las", LasOf(coarse_m, Vec3::Zero(), 32632));
  const auto refuse = [&](const Arguments& more,
                          const testing::Matcher<const std::string&>& message) {
    Arguments arguments = {"site"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"--out", "site"});
    ExpectRefused(scratch, arguments, message);
  };
  refuse({"wide.ply", "--cell", "0.01"}, HasSubstr("9750 x 9750 m found, a site has at most 2000"));
  refuse({"coarse.ply", "--cell", "0.05"}, HasSubstr("use --cell 0.5"));
  refuse({"feet.las"}, HasSubstr("need metres"));
  refuse({"degrees.las"}, HasSubstr("reproject it"));
  refuse({"map.las", "--map", "EPSG:25832"}, HasSubstr("remove --map"));
  refuse({"coarse.ply", "--map", "EPSG:nought"}, HasSubstr("--map: reference system"));
  refuse({"map.las", "--local"}, HasSubstr("--local: the survey is in"));
  refuse({"map.las", "--origin", "47", "8", "400"}, HasSubstr("--origin: the survey is in"));
  fs::create_directories(scratch.path() / "site" / "old");
  refuse({"coarse.ply"}, HasSubstr("site: is not an empty directory"));
}

}  // namespace
}  // namespace tera
