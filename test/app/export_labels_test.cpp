#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/other_program.h"
#include "app/refused.h"
#include "core/faults.h"

// Exports of pictures, scans and labels, compared with the dataset by programs that follow only the
// formats' descriptions (judges/check_*.py).

namespace tera {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// An excavator that drives and turns past another, a truck, a tree and a walking person. Its front
/// camera has a distorting lens, the boom's camera none.
constexpr const char* kYard = R"(name: yard
seed: 5
duration_s: 1
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [30, 30], cell_m: 0.1, soil: dirt}
record: {poses_hz: 100}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [-6, 0], yaw_deg: 20, joints_deg: {boom: 55, arm: -120, bucket: -20}}
    operator: {type: waypoints, waypoints: [{xy_m: [0, 6]}], speed_mps: 1.2}
    rig: {sensors: [
      {name: front, preset: tera:config/sensors/rgb_640.yaml, link: upper, xyz_m: [0.6, 0.3, 1.6],
       rpy_deg: [0, 8, -4], width_px: 200, height_px: 150, horizontal_fov_deg: 90, rate_hz: 10,
       lens: rational, p1: 0.004, p2: -0.006, k3: 0.003, k4: 0.01, k5: -0.004, k6: 0.002,
       depth: true, rgb_noise: 0},
      {name: boom_eye, type: camera, link: boom, xyz_m: [1, 0, 0.5], rpy_deg: [0, 40, 0],
       width_px: 96, height_px: 72, horizontal_fov_deg: 70, rate_hz: 5, depth: true, rgb: true,
       labels: true},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0, 2],
       rpy_deg: [0, 5, 3], columns: 512, range_noise_m: 0},
      {name: imu, type: imu, link: upper, rate_hz: 200}]}
  - name: other
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [3, 4], yaw_deg: 130, joints_deg: {boom: 50, arm: -110, bucket: -30}}
    operator: {type: idle}
obstacles:
  - {name: truck1, preset: tera:config/obstacles/truck.yaml, xy_m: [4, 9], yaw_deg: 160}
  - {name: walker, preset: tera:config/obstacles/person.yaml, xy_m: [-1, 4],
     path: [{t_s: 0, xy_m: [-1, 4]}, {t_s: 1, xy_m: [-1, 5.5]}]}
  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [-1, 2.5], yaw_deg: 0}
  - {name: tree1, preset: tera:config/obstacles/tree.yaml, xy_m: [9, 3], yaw_deg: 0}
  - {name: fence1, preset: tera:config/obstacles/fence.yaml, xy_m: [-4.2, 4.5], yaw_deg: 30}
)";

constexpr const char* kCard = R"(description: An excavator's yard.
license: https://spdx.org/licenses/CC-BY-4.0.html
url: https://data.example/yard
date_published: 2026-05-01
person: A. Digger
)";

class ExportLabels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = std::make_unique<ScratchDirectory>();
    WriteWholeFile(scratch_->path() / "yard.yaml", kYard);
    const Outcome made = RunTera({"generate", "yard.yaml", "--out", "run"}, {scratch_->path()});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  static void TearDownTestSuite() { scratch_.reset(); }

  static void Exported(const Arguments& to, const std::string& out) {
    Arguments arguments = {"export", "run", "--out", out, "--to"};
    arguments.insert(arguments.end(), to.begin(), to.end());
    const Outcome outcome = RunTera(arguments, {scratch_->path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  static fs::path Path(const std::string& file) { return scratch_->path() / file; }
  /// A judge's result; fails the test if it reports a fault.
  static json Judged(const std::string& judge, const std::string& arguments) {
    const auto seen =
        OutputOf(fmt::format("cd {} && {} -B {}/test/app/judges/{} {}", Path("").string(),
                             TERA_PYTHON, TERA_SOURCE_DIR, judge, arguments));
    EXPECT_TRUE(seen) << judge;
    return seen ? json::parse(*seen) : json();
  }

  static std::unique_ptr<ScratchDirectory> scratch_;
};
std::unique_ptr<ScratchDirectory> ExportLabels::scratch_;

TEST_F(ExportLabels, CocosMasksBoxesAndSegmentsAreThoseOfTheDataset) {
  Exported({"coco"}, "coco");
  const json seen = Judged("check_coco.py", "run coco");
  EXPECT_EQ(seen["images"], 17);  // 11 of the front, 6 of the boom
  EXPECT_EQ(seen["cameras"], 2);
  EXPECT_GE(seen["annotations"], 80);
  EXPECT_GE(seen["wholes"], 12);
  EXPECT_GE(seen["segments"], 80);
  EXPECT_GE(seen["keypoints"], 200);
  EXPECT_GE(seen["seen_keypoints"], 50);
  EXPECT_EQ(seen["keypoint_categories"], json({"person", "vehicle_1"}));
}

TEST_F(ExportLabels, CocosFilesAreAsTheirSchemaSays) {
  if (!HasProgram("node") || !fs::is_directory(TERA_NODE_MODULES "/ajv")) {
    GTEST_SKIP() << "needs node and the npm package ajv: npm install it, and cmake -D "
                    "TERA_NODE_MODULES=FOLDER/node_modules";
  }
  Exported({"coco", "--start-utc", "2024-05-01T12:00:00Z"}, "dated");
  const auto seen = OutputOf(fmt::format(
      "node {0}/check_schema.mjs '{1}' {0}/coco.schema.json {2}/instances.json {2}/panoptic.json "
      "{2}/keypoints.json",
      TERA_SOURCE_DIR "/test/app/judges", TERA_NODE_MODULES, Path("dated/annotations").string()));
  EXPECT_TRUE(seen);
}

TEST_F(ExportLabels, KittisFoldersAreThoseOfItsDevelopmentKits) {
  Exported({"kitti"}, "kitti");
  const json seen = Judged("check_kitti.py", "run kitti digger/front digger/lidar digger/imu");
  EXPECT_EQ(seen["frames"], 10);  // scans from 0 to 0.9 s
  EXPECT_EQ(seen["types"],
            json({"DontCare", "Pedestrian", "Truck", "barrier", "cone", "vegetation", "vehicle"}));
  EXPECT_GE(seen["labels"], 50);
  EXPECT_GE(seen["points_in_boxes"], 2000);
  EXPECT_GE(seen["projected"], 2000);
  EXPECT_GE(seen["imu_frames"], 9);
  EXPECT_GT(seen["truncated"], 0.5);
  EXPECT_GT(seen["most_moved_m"], 0.05);
  EXPECT_GT(seen["travelled_m"], 0.3);
}

TEST_F(ExportLabels, NuscenesTablesPosesAndBoxesAreThoseOfTheDataset) {
  Exported({"nuscenes", "--key-frames-hz", "5"}, "nuscenes");
  const json seen = Judged("check_nuscenes.py", "run nuscenes digger 5");
  EXPECT_EQ(seen["samples"], 5);  // at 0.05 s and on
  EXPECT_EQ(seen["data"], 27);    // 11, 6 and 10
  EXPECT_EQ(seen["channels"], json({"CAM_BOOM_EYE", "CAM_FRONT", "LIDAR_TOP"}));
  EXPECT_GE(seen["annotations"], 20);
  EXPECT_GE(seen["points_in_boxes"], 500);
  EXPECT_EQ(seen["categories"],
            json({"human.pedestrian.construction_worker", "movable_object.barrier",
                  "movable_object.trafficcone", "static.vegetation", "vehicle.construction",
                  "vehicle.truck"}));
}

TEST_F(ExportLabels, SemanticKittisLabelsAndPosesAreThoseOfTheDataset) {
  Exported({"semantickitti"}, "semantickitti");
  const json seen = Judged("check_semantickitti.py", "run semantickitti digger/lidar");
  EXPECT_GE(seen["frames"], 10);
  EXPECT_GE(seen["points"], 15000);
  EXPECT_GE(seen["classes"], 6);
  EXPECT_GE(seen["instances"], 6);
  EXPECT_GT(seen["most_moved_m"], 0.05);
}

TEST_F(ExportLabels, WebdatasetsArchivesHoldTheDatasetsOwnFiles) {
  WriteWholeFile(Path("card.yaml"), kCard);
  Exported({"webdataset", "--shard-mb", "1", "--card", "card.yaml"}, "webdataset");
  const json seen =
      Judged("check_webdataset.py", "run webdataset digger/front digger/boom_eye digger/lidar");
  EXPECT_EQ(seen["samples"], 27);  // 11, 6 and 10
  EXPECT_GE(seen["shards"], 3);
  EXPECT_EQ(seen["parts"], 4 * 17 + 10);
  EXPECT_EQ(seen["file_sets"], 5 + 5 + 2);
  EXPECT_EQ(seen["record_sets"], 5 + 5 + 1);
}

TEST_F(ExportLabels, CroissantsTermsAreAllDefined) {
  if (!HasProgram("node") || !fs::is_directory(TERA_NODE_MODULES "/jsonld")) {
    GTEST_SKIP() << "needs node and the npm package jsonld: npm install it, and cmake -D "
                    "TERA_NODE_MODULES=FOLDER/node_modules";
  }
  WriteWholeFile(Path("card.yaml"), kCard);
  Exported({"webdataset", "--card", "card.yaml"}, "carded");
  const auto text =
      OutputOf(fmt::format("node {}/test/app/judges/check_jsonld.mjs '{}' {}", TERA_SOURCE_DIR,
                           TERA_NODE_MODULES, Path("carded/croissant.json").string()));
  ASSERT_TRUE(text);
  const json seen = json::parse(*text);
  const std::string cr = "http://mlcommons.org/croissant/";
  EXPECT_EQ(seen["kinds"][cr + "FileObject"], 3);
  EXPECT_EQ(seen["kinds"][cr + "FileSet"], 12);
  EXPECT_EQ(seen["kinds"][cr + "Field"], 2 * 11);
  EXPECT_EQ(seen["kinds"]["https://schema.org/Person"], 1);
  EXPECT_EQ(seen["conformsTo"][0]["@value"], cr + "1.1");
}

TEST_F(ExportLabels, WhatKittiCannotBeGivenIsRefused) {
  const auto refused = [&](Arguments arguments,
                           const testing::Matcher<const std::string&>& message) {
    arguments.insert(arguments.begin(), {"export", "run", "--out", "x", "--to"});
    ExpectRefused(*scratch_, arguments, message);
  };
  refused({"kitti", "--camera", "digger/rear"}, TellsOf("--camera"));
  refused({"kitti", "--lidar", "digger/front"}, TellsOf("--lidar"));
  refused({"coco", "--lidar", "digger/lidar"}, TellsOf("--lidar"));
  const Outcome layout = RunTera(
      {"export", "run", "--out", "x", "--to", "kitti", "--layout", "raw,stereo"}, {Path("")});
  EXPECT_EQ(layout.status, 2);
  EXPECT_THAT(layout.err, TellsOf("--layout"));
}

}  // namespace
}  // namespace tera
