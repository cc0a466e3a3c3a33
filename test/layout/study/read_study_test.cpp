#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"
#include "layout/study/study.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::ElementsAre;

LayoutStudy Read(const std::string& text) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "study.yaml", text);
  return LoadStudy(scratch.path() / "study.yaml");
}

void ExpectRefused(const std::string& text, const FaultsMatcher& fault) {
  EXPECT_THAT([&] { Read(text); },
              testing::Throws<InputError>(testing::Property(&InputError::faults, fault)))
      << text;
}

TEST(LoadStudy, RefusesWhatIsNone) {
  EXPECT_THAT([] { LoadStudy("absent.yaml"); },
              testing::Throws<InputError>(
                  testing::Property(&InputError::faults, HasFaultAt("absent.yaml"))));
  ExpectRefused("[1, 2]\n", HasFaultAt("study.yaml"));
  ExpectRefused("zone: []\n", HasFault(kUnknown, "zone"));
  ExpectRefused("rate_hz: 0\n", HasFault(kOutOfRange, "rate_hz"));
  ExpectRefused("rate_hz: .nan\n", HasFaultAt("rate_hz"));
  ExpectRefused("points: 0\n", HasFault(kOutOfRange, "points"));
  ExpectRefused("points: 2.5\n", HasFaultAt("points"));
  ExpectRefused("points: 99999999999\n", HasFaultAt("points"));
  ExpectRefused("seed: -1\n", HasFaultAt("seed"));
  ExpectRefused("radius_m: -1\n", HasFaultAt("radius_m"));
  ExpectRefused("height_m: 0\n", HasFaultAt("height_m"));
  ExpectRefused("map_heights_m: []\n", HasFaultAt("map_heights_m"));
  ExpectRefused("map_heights_m: [1, -1]\n", HasFaultAt("map_heights_m"));
  ExpectRefused("seen: {reflectance: 0}\n", HasFaultAt("seen.reflectance"));
  ExpectRefused("seen: {lidar_points_per_m2: -1}\n", HasFaultAt("seen.lidar_points_per_m2"));
  ExpectRefused("air: {visibility_m: 0}\n", HasFault(kOutOfRange, "air.visibility_m"));
  ExpectRefused("air: {rain_mmph: -1}\n", HasFault(kOutOfRange, "air.rain_mmph"));
  ExpectRefused("air: {fog_m: 50}\n", HasFault(kUnknown, "air.fog_m"));
  ExpectRefused("person: {lidar_points: 0}\n", HasFaultAt("person.lidar_points"));
  ExpectRefused("person: {cluster_points: 0}\n", HasFaultAt("person.cluster_points"));
  ExpectRefused("person: {cluster_points: 2.5}\n", HasFaultAt("person.cluster_points"));
  ExpectRefused("person: {farthest_m: 0.5}\n", HasFaultAt("person.farthest_m"));
  ExpectRefused("person: {postures: [{name: tall}]}\n", HasFaultAt("size_m"));
  ExpectRefused("person: {postures: [{name: flat, size_m: [1, 0, 1]}]}\n", HasFaultAt("size_m"));
  ExpectRefused("eye: {xyz_m: [0, 0, 1]}\n", HasFaultAt("eye.link"));
}

TEST(LoadStudy, RefusesTwoOfOneName) {
  // Figures are known by these names.
  const std::string box = "{name: a, box_m: [1, 1, 1]}";
  ExpectRefused("zones: [" + box + ", " + box + "]\n", HasFault(kRepeated, "name"));
  const std::string tall = "{name: tall, size_m: [1, 1, 1]}";
  ExpectRefused("person: {postures: [" + tall + ", " + tall + "]}\n",
                HasFaultAt("postures[1].name"));
  ExpectRefused("map_heights_m: [0.9, 1.5, 0.9]\n", HasFaultAt("map_heights_m"));
}

TEST(LoadStudy, RefusesNamesThatCannotNameAColumn) {
  for (const std::string name : {"a,b", "a/b", "a b"}) {
    ExpectRefused("zones: [{name: \"" + name + "\", box_m: [1, 1, 1]}]\n",
                  HasFaultAt("zones[0].name"));
    ExpectRefused("person: {postures: [{name: \"" + name + "\", size_m: [1, 1, 1]}]}\n",
                  HasFaultAt("person.postures[0].name"));
  }
}

TEST(LoadStudy, WithoutAFileHasTheCommonPostures) {
  const LayoutStudy study = LoadStudy({});
  ASSERT_EQ(study.person.postures.size(), 3u);
  EXPECT_EQ(study.person.postures[0].name, "standing");
  EXPECT_TRUE(study.zones.empty());
  EXPECT_FALSE(study.eye.has_value());
}

TEST(LoadStudy, OfCommentsAloneIsThatWithoutAFile) {
  for (const char* text : {"", "# what most ask\n\n  # nothing else", "\r\n"}) {
    EXPECT_EQ(Read(text).resolved_yaml, LoadStudy({}).resolved_yaml) << text;
  }
  ExpectRefused("# a list\n- 1\n", HasFaultAt("study.yaml"));
}

TEST(LoadStudy, TakesEveryKey) {
  const LayoutStudy study = Read(R"(
machine: excavator2
upper: boom
rate_hz: 4
radius_m: 9
height_m: 3
points: 700
seed: 12
map_heights_m: [0.3, 1.1]
zones: [{name: a, box_m: [1, 2, 3]}, {name: b, cylinder: {radius_m: 1, height_m: 2}}]
seen: {lidar_points_per_m2: 7, camera_px_per_m: 40, reflectance: 0.3}
person: {postures: [{name: child, size_m: [0.2, 0.3, 1.1]}], lidar_points: 11, camera_px: 90, cluster_points: 7,
         farthest_m: 15}
eye: {link: upper, xyz_m: [0.1, 0.2, 1.3], spacing_m: 0.1, circle_m: 10, rectangle_m: 2, height_m: 0.5}
)");
  EXPECT_EQ(study.machine, "excavator2");
  EXPECT_EQ(study.upper, "boom");
  EXPECT_EQ(study.rate_hz, 4);
  EXPECT_EQ(study.radius_m, 9);
  EXPECT_EQ(study.height_m, 3);
  EXPECT_EQ(study.points, 700);
  EXPECT_EQ(study.seed, 12u);
  EXPECT_THAT(study.map_heights_m, ElementsAre(0.3, 1.1));
  ASSERT_EQ(study.zones.size(), 2u);
  EXPECT_EQ(study.zones[1].name, "b");
  EXPECT_EQ(study.seen.lidar_points_per_m2, 7);
  EXPECT_EQ(study.seen.camera_px_per_m, 40);
  EXPECT_EQ(study.seen.reflectance, 0.3);
  ASSERT_EQ(study.person.postures.size(), 1u);
  EXPECT_EQ(study.person.postures[0].size_m, Vec3(0.2, 0.3, 1.1));
  EXPECT_EQ(study.person.lidar_points, 11);
  EXPECT_EQ(study.person.camera_px, 90);
  EXPECT_EQ(study.person.cluster_points, 7);
  EXPECT_EQ(study.person.farthest_m, 15);
  ASSERT_TRUE(study.eye.has_value());
  EXPECT_EQ(study.eye->link, "upper");
  EXPECT_EQ(study.eye->p_B_m, Vec3(0.1, 0.2, 1.3));
  EXPECT_EQ(study.eye->spacing_m, 0.1);
  EXPECT_EQ(study.eye->circle_m, 10);
  EXPECT_EQ(study.eye->rectangle_m, 2);
  EXPECT_EQ(study.eye->height_m, 0.5);
}

}  // namespace
}  // namespace tera
