#include "dataset/export/ros/ground_snapshots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/export/export.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/ros/serializer.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// Three squares to the east and two to the north, with values that identify them: 10 j + i.
GroundSquares Numbered(const fs::path& file, const std::string& layer) {
  const float base = layer == "elevation" ? 0.0f : 100.0f;
  GroundSquares squares{Vec2(-1, 2), 0.5, 3, 2, {}};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) squares.values.push_back(base + static_cast<float>(10 * j + i));
  }
  if (file.stem() == "density_300000000") squares.low_W_m.x() = 7;
  return squares;
}

class GroundSnapshots : public testing::Test {
 protected:
  GroundSnapshots() {
    WriteWholeSample(run(), {});
    for (const char* name :
         {"height_start.tif", "soil_class_start.tif", "height_200000000.tif", "height_end.tif",
          "change_end.tif", "pit_end.vti", "height_soon.tif"}) {
      Leave(name);
    }
  }
  fs::path run() const { return scratch_.path() / "run"; }
  void Leave(const std::string& name) { WriteWholeFile(run() / "truth/terrain" / name, "raster"); }

  ScratchDirectory scratch_;
};

TEST_F(GroundSnapshots, AreTheRastersOfOneTimeInOrderOfTime) {
  const auto snapshots = GroundSnapshotsOf(Recording(run()));
  ASSERT_EQ(snapshots.size(), 3u);
  EXPECT_EQ(snapshots[0].t_ns, 0);
  ASSERT_EQ(snapshots[0].layers.size(), 2u);
  EXPECT_EQ(snapshots[0].layers.at("elevation").filename(), "height_start.tif");
  EXPECT_TRUE(snapshots[0].layers.contains("soil_class"));
  EXPECT_EQ(snapshots[1].t_ns, 200'000'000);
  EXPECT_EQ(snapshots[2].t_ns, 500'000'000);  // the sample lasts 0.5 s
  EXPECT_TRUE(snapshots[2].layers.contains("change"));
}

// By GridMap.msg and GridMapRosConverter: columns of a grid map are lines of one y, the first of
// the greatest; each runs from the greatest x down.
TEST_F(GroundSnapshots, AsGridMapsBeginInTheNorthEast) {
  const auto snapshots = GroundSnapshotsOf(Recording(run()));
  const ros::GridMap map = GridMapOf(snapshots[0], 5, Numbered);
  EXPECT_EQ(map.header.frame_id, "map");
  EXPECT_EQ(map.resolution_m, 0.5);
  EXPECT_EQ(map.rows, 3u);
  EXPECT_EQ(map.columns, 2u);
  EXPECT_EQ(map.middle.translation(), Vec3(-0.25, 2.5, 0));
  ASSERT_EQ(map.layers.size(), 2u);
  EXPECT_EQ(map.layers[0].name, "elevation");
  EXPECT_THAT(map.layers[0].values, ElementsAre(12, 11, 10, 2, 1, 0));
  EXPECT_EQ(map.layers[1].name, "soil_class");
  EXPECT_EQ(map.layers[1].values.front(), 112);
}

TEST_F(GroundSnapshots, HaveTheBytesOfTheDefinition) {
  const GroundSnapshot snapshot{0, {{"elevation", run() / "truth/terrain/height_start.tif"}}};
  const ros::GridMap map = GridMapOf(snapshot, 3'000'000'007, Numbered);
  ros::Serializer cdr(ros::WireForm::kCdr), ros1(ros::WireForm::kRos1);
  cdr.Put(map);
  Cdr expected;
  expected.Add(std::int32_t{3}).Add(std::uint32_t{7}).Text("map");
  expected.Add(0.5).Add(1.5).Add(1.0);
  for (const double pose : {-0.25, 2.5, 0.0, 0.0, 0.0, 0.0, 1.0}) expected.Add(pose);
  for (int list = 0; list < 2; ++list) expected.Add(std::uint32_t{1}).Text("elevation");
  expected.Add(std::uint32_t{1}).Add(std::uint32_t{2});
  expected.Text("column_index").Add(std::uint32_t{2}).Add(std::uint32_t{6});
  expected.Text("row_index").Add(std::uint32_t{3}).Add(std::uint32_t{3});
  expected.Add(std::uint32_t{0}).Add(std::uint32_t{6});
  for (const float value : {12.0f, 11.0f, 10.0f, 2.0f, 1.0f, 0.0f}) expected.Add(value);
  expected.Add(std::uint16_t{0}).Add(std::uint16_t{0});
  EXPECT_EQ(cdr.bytes(), expected.bytes());
  // Packed, texts without their 0, and with the header's number before the stamp.
  ros1.Put(map);
  EXPECT_EQ(ros1.bytes().size(), 4u + 8 + 4 + 3 + 3 * 8 + 7 * 8 + 2 * (4 + 4 + 9) + 4 + 4 +
                                     (4 + 12 + 8) + (4 + 9 + 8) + 4 + 4 + 6 * 4 + 4);
}

TEST_F(GroundSnapshots, AreMessagesOfABagWhereTheRastersCanBeRead) {
  const fs::path out = scratch_.path() / "out";
  Export(run(), out, {.format = ExportFormat::kRosbag2, .read_ground = Numbered});
  const std::string metadata = ReadWholeFile(out / "metadata.yaml");
  const std::size_t at = metadata.find("name: /truth/terrain");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(metadata.substr(at), HasSubstr("type: grid_map_msgs/msg/GridMap"));
  const std::size_t count = metadata.find("message_count: ", at);
  EXPECT_EQ(metadata.substr(count, 16), "message_count: 3");
  fs::remove_all(out);
  Export(run(), out, {.format = ExportFormat::kRosbag2});
  EXPECT_EQ(ReadWholeFile(out / "metadata.yaml").find("/truth/terrain"), std::string::npos);
}

TEST_F(GroundSnapshots, RastersThatDoNotLieAlikeAreNamed) {
  Leave("height_300000000.tif");
  Leave("density_300000000.tif");
  const auto export_bag = [&] {
    Export(run(), scratch_.path() / "out",
           {.format = ExportFormat::kRosbag2, .read_ground = Numbered});
  };
  EXPECT_THAT(export_bag, ThrowsFault(kInconsistent, "height_300000000.tif"));
}

}  // namespace
}  // namespace tera
