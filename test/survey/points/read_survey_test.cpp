#include "survey/points/read_survey.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/export/cloud/las.h"
#include "dataset/import/cloud/read_point_cloud.h"
#include "own_folder.h"
#include "survey/points/coarse_steps.h"
#include "survey/survey_files.h"

// Checks of a cloud's numbers, and of its map.

namespace tera {
namespace {

using enum FaultKind;
using testing::AllOf;
using testing::HasSubstr;
using testing_survey::LasOf;
using testing_survey::PlyOf;
using testing_survey::WriteBytes;

const Vec3 kUtm_m(600'000, 5'250'000, 420);

/// Twelve by nine metres of ground, with points anywhere in it.
PointCloud CloudAt(const Vec3& low_m, const std::function<double(double)>& stored) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  PointCloud cloud;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p_m =
        low_m + Vec3(12, 9, 0.5).cwiseProduct(Vec3(part(random), part(random), part(random)));
    cloud.p_m.emplace_back(stored(p_m.x()), stored(p_m.y()), stored(p_m.z()));
  }
  return cloud;
}

double AsFloat(double value) { return static_cast<double>(static_cast<float>(value)); }

// Floats have 24 bits: from 2^22 = 4 194 304 on they are 0.5 apart, from 2^19 on 0.0625.
TEST(CoarseSteps, OfSinglePrecisionAreThoseOfFloatsOfThatSize) {
  const auto found = FindCoarseSteps(CloudAt(kUtm_m, AsFloat));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->axis, 'y');
  EXPECT_EQ(found->step_m, 0.5);
  EXPECT_THAT(found->cause, HasSubstr("too large for single precision; export it in double"));
  // LV95, whose easting is the larger: 2^21 to 2^22.
  const auto swiss = FindCoarseSteps(CloudAt(Vec3(2'600'000, 1'200'000, 550), AsFloat));
  ASSERT_TRUE(swiss);
  EXPECT_EQ(swiss->axis, 'x');
  EXPECT_EQ(swiss->step_m, 0.25);
  // A cloud with a reduced easting only has steps in northing.
  const auto half = FindCoarseSteps(CloudAt(Vec3(0, 5'250'000, 420), AsFloat));
  ASSERT_TRUE(half);
  EXPECT_EQ(half->axis, 'y');
}

TEST(CoarseSteps, AreNotFoundWhereTheNumbersSuffice) {
  const auto as_written = [](double value) { return value; };
  const auto in_millimetres = [](double value) { return std::round(1000 * value) / 1000; };
  EXPECT_FALSE(FindCoarseSteps(CloudAt(kUtm_m, as_written)));
  EXPECT_FALSE(FindCoarseSteps(CloudAt(kUtm_m, in_millimetres)));
  EXPECT_FALSE(FindCoarseSteps(CloudAt(Vec3::Zero(), AsFloat)));
  EXPECT_FALSE(FindCoarseSteps(CloudAt(Vec3(50'000, 10'000, 420), AsFloat)));  // 4 mm
  EXPECT_FALSE(FindCoarseSteps(PointCloud()));
}

// The points of a terrain model have whole and half metres, exact in floats.
TEST(CoarseSteps, AreNotThoseOfARegularGrid) {
  for (const double spacing_m : {0.25, 0.5, 1.0}) {
    PointCloud grid;
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 50; ++i) {
        grid.p_m.push_back(kUtm_m + Vec3(spacing_m * i, spacing_m * j, 0.01 * ((7 * i + j) % 13)));
      }
    }
    EXPECT_FALSE(FindCoarseSteps(grid)) << spacing_m;
  }
}

TEST(CoarseSteps, OfNumbersWithFewDigitsAreThoseOfTheLast) {
  const auto seven_digits = [](double value) { return std::stod(fmt::format("{:.7g}", value)); };
  const auto found = FindCoarseSteps(CloudAt(kUtm_m, seven_digits));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->axis, 'y');
  EXPECT_NEAR(found->step_m, 1, 1e-9);
  EXPECT_THAT(found->cause, HasSubstr("too few digits"));
}

TEST(CoarseSteps, OfLasAreItsScale) {
  PointCloud cloud = CloudAt(kUtm_m, [](double value) { return value; });
  cloud.step_m = Vec3(0.01, 0.01, 0.25);
  const auto found = FindCoarseSteps(cloud);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->axis, 'z');
  EXPECT_EQ(found->step_m, 0.25);
  EXPECT_THAT(found->cause, HasSubstr("the scale of the file"));
}

TEST(CoarseSteps, OfSinglePrecisionAreFoundInALasFileThatRoundedThem) {
  for (const double scale_m : {0.001, 0.01}) {
    PointCloud cloud = CloudAt(
        kUtm_m, [&](double value) { return scale_m * std::round(AsFloat(value) / scale_m); });
    cloud.step_m = Vec3::Constant(scale_m);
    const auto found = FindCoarseSteps(cloud);
    ASSERT_TRUE(found) << scale_m;
    EXPECT_EQ(found->step_m, 0.5);
    cloud = CloudAt(kUtm_m, [&](double value) { return scale_m * std::round(value / scale_m); });
    cloud.step_m = Vec3::Constant(scale_m);
    EXPECT_FALSE(FindCoarseSteps(cloud)) << scale_m;
  }
}

TEST(ReadSurvey, TakesCoarseStepsOnlyWhereSuchWillDo) {
  const auto file = OwnFolder() / "pit.ply";
  WriteBytes(file, PlyOf(CloudAt(kUtm_m, AsFloat).p_m));
  EXPECT_THAT([&] { ReadSurvey(file); }, ThrowsFault(kOutOfRange, "pit.ply"));
  EXPECT_THAT(ReadSurvey(file, {.map = "", .coarsest_step_m = 0.5}).warnings,
              testing::ElementsAre(HasSubstr("y has steps of 0.5 m")));
}

TEST(ReadSurvey, NamesTheProgramThatMakesASurveyOfPointsAsTextAndOfOtherRasters) {
  for (const auto& [name, program] : {std::pair{"site.xyz", "pdal translate"},
                                      {"site.TXT", "pdal translate"},
                                      {"site.asc", "gdal_translate"}}) {
    const auto file = OwnFolder() / name;
    WriteBytes(file, "1 2 3\n");
    const auto faults = FaultsIn([&] { ReadSurvey(file); });
    ASSERT_THAT(faults, HasOnlyFault(kUnsupported, name));
    EXPECT_THAT(faults[0].finding, HasSubstr(program));
  }
}

TEST(ReadSurvey, ANamedMapCountsWhereTheFilesOwnCannotBeRead) {
  const auto file = OwnFolder() / "broken.las";
  WriteBytes(file, LasOf({kUtm_m, kUtm_m + Vec3(1, 2, 3)}, kUtm_m, 32767));
  EXPECT_THAT([&] { ReadSurvey(file); }, ThrowsFault(kMalformed, "broken.las"));
  const Survey survey = ReadSurvey(file, {.map = "EPSG:32632"});
  ASSERT_TRUE(survey.map);
  EXPECT_EQ(survey.map->name, "WGS 84 / UTM zone 32N");
  EXPECT_THAT(survey.warnings,
              testing::ElementsAre(AllOf(HasSubstr("not understood"), HasSubstr("EPSG:32632"))));
}

TEST(ReadSurvey, AnotherMapOrNoneCountsWhereTheFilesOwnIsForAnotherPlace) {
  const auto file = OwnFolder() / "odd.las";
  const Vec3 bern_m(2'600'000, 1'200'000, 550);
  WriteBytes(file, LasOf({bern_m, bern_m + Vec3(1, 2, 3)}, bern_m, 32632));
  EXPECT_THAT([&] { ReadSurvey(file); }, ThrowsFault(kInconsistent, "odd.las"));
  EXPECT_EQ(ReadSurvey(file, {.map = "EPSG:2056"}).map->name, "CH1903+ / LV95");
  const Survey local = ReadSurvey(file, {.map = "", .is_local = true});
  EXPECT_FALSE(local.map);
  EXPECT_THAT(local.warnings, testing::ElementsAre(HasSubstr("--local counts")));
}

TEST(ReadSurvey, RefusesAMapThatIsForAnotherPlace) {
  const auto file = OwnFolder() / "bern.ply";
  WriteBytes(file, PlyOf({Vec3(2'600'000, 1'200'000, 550), Vec3(2'600'001, 1'200'002, 551)}));
  EXPECT_THAT([&] { ReadSurvey(file, {.map = "EPSG:32632"}); },
              ThrowsFault(kInconsistent, "--map"));
  EXPECT_EQ(ReadSurvey(file, {.map = "EPSG:2056"}).map->name, "CH1903+ / LV95");
}

// A recording's own points, exported as LAS and read as a survey, lie in W about its origin again.
TEST(ReadSurvey, OfAnExportedMapLiesWhereItWasRecorded) {
  DatasetInfo info;
  info.origin_lat_deg = 46.78;
  info.origin_lon_deg = -71.27;
  info.origin_height_m = 90.5;
  const Vec3 p_W_m(30, -12, 1.5);
  MapPoint point;
  point.p_m = LasPlaces(info)(p_W_m);
  std::string bytes = LasHeader({1, point.p_m, point.p_m}, info);
  AppendLasPoint(point, &bytes);
  const auto file = OwnFolder() / "map.las";
  WriteBytes(file, bytes);
  const Survey survey = ReadSurvey(file);
  ASSERT_TRUE(survey.map);
  EXPECT_EQ(survey.map->name, "Site plane");
  const auto in_W = PlacesInW(*survey.map, {46.78, -71.27, 90.5}, {survey.p_m[0].head<2>()});
  EXPECT_LT((in_W[0] - p_W_m.head<2>()).norm(), 1e-3);
  EXPECT_NEAR(survey.p_m[0].z(), 92, 1e-3);
}

}  // namespace
}  // namespace tera
