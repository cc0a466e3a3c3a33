#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/export/cloud/las.h"
#include "dataset/export/export.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/sample_recording.h"

// The merged map of a machine whose boom turns under its lidar.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kLidarSheet =
    "type: lidar\nname: eye\nparent_link: boom\nX_parent_sensor:\n"
    "  xyz_m: [2, 0, 0]\n  quaternion_wxyz: [1, 0, 0, 0]\nrate_hz: 1\nlatency_s: 0\n";

/// The boom's pin is 1 m above the root's origin; it turns about z.
std::vector<JointTree> Tree() {
  JointTree tree{"digger", "chassis"};
  tree.joints.push_back({"boom", "chassis", "boom", JointTree::Motion::kTurns,
                         MakePose(Vec3(0, 0, 1)), Vec3::UnitZ()});
  return {tree};
}

LidarPoint PointAt(float x_m, std::uint32_t time_ns) {
  LidarPoint point;
  point.x_m = x_m;
  point.intensity = 0.5f;
  point.time_offset_ns = time_ns;
  point.ring = 3;
  point.instance = 258;
  point.label = static_cast<std::uint8_t>(SemanticClass::kTerrain);
  return point;
}

class MapsTest : public testing::Test {
 protected:
  MapsTest() {
    DatasetWriter writer(recording(), SampleInfo(), {});
    const ChannelId lidar = writer.AddChannel(LidarChannel("digger/eye", kLidarSheet));
    const ChannelId pose = writer.AddChannel(PoseChannel("truth/digger/pose.csv"));
    const ChannelId joints =
        writer.AddChannel(TableChannel("truth/digger/joints.csv", {"boom_rad", "boom_radps"}));
    for (const double t_s : {0.0, 1.0}) {
      const TimeNs t_ns = FromSeconds(t_s);
      // Looks north, 10 m east of the origin.
      writer.Write(pose, RowOf(TruthPose{t_ns, MakePose(Vec3(10, 0, 0), 0, 0, 90 * kDeg)}));
      writer.Write(joints, RowSample{t_ns, t_ns, {t_s * 90 * kDeg, 90 * kDeg}});
    }
    writer.Write(lidar, LidarScan{0, 0, {PointAt(3, 0), PointAt(3, 1'000'000'000)}});
    writer.Finish();
  }
  fs::path recording() const { return scratch_.path() / "run"; }
  std::string Written(ExportFormat format, const std::string& file) {
    Export(recording(), scratch_.path() / "out", {.format = format, .joint_trees = Tree});
    return ReadWholeFile(scratch_.path() / "out" / file);
  }
  ScratchDirectory scratch_;
};

template <typename T>
T At(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

Vec3 PackedPlace(const std::string& bytes, std::size_t point) {
  const std::size_t at = point;
  return {At<float>(bytes, at), At<float>(bytes, at + 4), At<float>(bytes, at + 8)};
}

constexpr std::size_t kPackedBytes = 4 * 4 + 8 + 3 * 2 + 1;

/// The lidar is 2 m along the boom and sees 3 m further: 5 m from the pin at (10, 0, 1), first to
/// the north and, after a quarter turn to the left, to the west.
void ExpectPackedPoints(const std::string& points) {
  ASSERT_EQ(points.size(), 2 * kPackedBytes);
  EXPECT_TRUE(PackedPlace(points, 0).isApprox(Vec3(10, 5, 1), 1e-6));
  EXPECT_TRUE(PackedPlace(points, kPackedBytes).isApprox(Vec3(5, 0, 1), 1e-6));
  EXPECT_EQ(At<float>(points, 12), 0.5f);
  EXPECT_EQ(At<double>(points, kPackedBytes + 16), 1.0);
  EXPECT_EQ(At<std::uint16_t>(points, 24), 258);
  EXPECT_EQ(At<std::uint16_t>(points, 26), 3);
  EXPECT_EQ(points[30], 1);
}

TEST_F(MapsTest, EachPointOfAPcdIsWhereItsOwnRayHit) {
  const std::string pcd = Written(ExportFormat::kPcd, "map.pcd");
  const std::string end = "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA binary\n";
  const std::size_t at = pcd.find(end);
  ASSERT_NE(at, std::string::npos) << pcd;
  ExpectPackedPoints(pcd.substr(at + end.size()));
}

TEST_F(MapsTest, APlyHasTheSamePoints) {
  const std::string ply = Written(ExportFormat::kPly, "map.ply");
  EXPECT_THAT(ply, HasSubstr("element vertex 2\n"));
  const std::string end = "end_header\n";
  ExpectPackedPoints(ply.substr(ply.find(end) + end.size()));
}

// Offsets of the public header block and of point format 6, by the tables of LAS 1.4 R15.
TEST_F(MapsTest, ALasSaysWhereItsPointsAreAndHowMany) {
  const std::string las = Written(ExportFormat::kLas, "map.las");
  EXPECT_EQ(las.substr(0, 4), "LASF");
  EXPECT_EQ(las[24], 1);
  EXPECT_EQ(las[25], 4);
  EXPECT_EQ(At<std::uint16_t>(las, 94), 375);
  const auto points = At<std::uint32_t>(las, 96);
  EXPECT_EQ(las[104], 6);
  EXPECT_EQ(At<std::uint16_t>(las, 105), 30);
  ASSERT_EQ(las.size(), points + 2 * 30);
  EXPECT_EQ(At<double>(las, 131), 1e-4);
  EXPECT_EQ(At<std::uint16_t>(las, 6), 16);    // reference system by WKT
  EXPECT_DOUBLE_EQ(At<double>(las, 179), 10);  // most x, least x, most y, least y
  EXPECT_DOUBLE_EQ(At<double>(las, 187), 5);
  EXPECT_DOUBLE_EQ(At<double>(las, 195), 5);
  EXPECT_NEAR(At<double>(las, 203), 0, 1e-12);
  EXPECT_EQ(At<std::uint64_t>(las, 247), 2u);
  EXPECT_EQ(At<std::int32_t>(las, points), 100'000);
  EXPECT_EQ(At<std::int32_t>(las, points + 4), 50'000);
  EXPECT_EQ(At<std::int32_t>(las, points + 8), 915'000);  // 1 m above the origin's 90.5 m
  EXPECT_EQ(At<std::uint16_t>(las, points + 12), 32768);
  EXPECT_EQ(las[points + 14], 0x11);  // the first of one return
  EXPECT_EQ(las[points + 16], 2);     // ground
  EXPECT_EQ(At<std::uint16_t>(las, points + 20), 1);
  EXPECT_EQ(At<double>(las, points + 30 + 22), 1.0);
}

/// The text of the record that names the reference system, by the tables of LAS 1.4 R15.
std::string WktRecord(const std::string& las) {
  const auto header = At<std::uint16_t>(las, 94);
  EXPECT_EQ(At<std::uint32_t>(las, 100), 1u);
  EXPECT_EQ(las.substr(header + 2, 15), "LASF_Projection");
  EXPECT_EQ(At<std::uint16_t>(las, header + 18), 2112);
  const std::string wkt = las.substr(header + 54, At<std::uint16_t>(las, header + 20));
  EXPECT_EQ(At<std::uint32_t>(las, 96), header + 54 + wkt.size());
  EXPECT_EQ(wkt.find('\0'), wkt.size() - 1);
  return wkt.substr(0, wkt.size() - 1);
}

TEST_F(MapsTest, ALasNamesThePlaneOfItsSiteOnTheEarth) {
  const std::string wkt = WktRecord(Written(ExportFormat::kLas, "map.las"));
  EXPECT_THAT(wkt, testing::StartsWith("PROJCS[\"Site plane\",GEOGCS[\"WGS 84\""));
  for (const char* part :
       {"PROJECTION[\"Transverse_Mercator\"]", "PARAMETER[\"latitude_of_origin\",46.78]",
        "PARAMETER[\"central_meridian\",-71.27]", "PARAMETER[\"scale_factor\",1]",
        "PARAMETER[\"false_easting\",0]", "UNIT[\"metre\",1]"}) {
    EXPECT_THAT(wkt, HasSubstr(part));
  }
}

TEST_F(MapsTest, ALasOfARecordingWithoutAPlaceOnTheEarthIsLocal) {
  std::string yaml = ReadWholeFile(recording() / "dataset.yaml");
  const std::string origin = "origin: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90.5}";
  yaml.replace(yaml.find(origin), origin.size(), "origin: {lat_deg: 0, lon_deg: 0, height_m: 0}");
  WriteWholeFile(recording() / "dataset.yaml", yaml);
  const std::string las = Written(ExportFormat::kLas, "map.las");
  EXPECT_THAT(WktRecord(las), testing::StartsWith("LOCAL_CS["));
  EXPECT_EQ(At<std::int32_t>(las, At<std::uint32_t>(las, 96) + 8), 10'000);
}

// The tangent plane at a place leaves the ellipsoid by d^2 / 2R: 7.83 m at 10 km to the east, with
// R = 6 389 km at 46.78 deg N.
TEST(LasPlaces, HeightsAreAboveTheEllipsoid) {
  const Vec3 place_m = LasPlaces(SampleInfo())(Vec3(10'000, 0, 3));
  EXPECT_NEAR(place_m.z(), 90.5 + 3 + 1e8 / (2 * 6'389'000.0), 0.01);
  EXPECT_EQ(place_m.head<2>(), Vec2(10'000, 0));
}

// Classes 64 to 255 are the users' own, 0 to 63 the standard's.
TEST(LasPoint, OfALabelWithoutAPlaceAmongTheUsersClassesIsUnclassified) {
  const auto class_of = [&](int label) {
    MapPoint point;
    point.label = static_cast<std::uint8_t>(label);
    std::string bytes;
    AppendLasPoint(point, &bytes);
    return static_cast<unsigned char>(bytes[16]);
  };
  EXPECT_EQ(class_of(11), 75);  // a person
  EXPECT_EQ(class_of(191), 255);
  for (int label = 192; label < 256; ++label) EXPECT_EQ(class_of(label), 1) << label;
}

TEST_F(MapsTest, PosesOfTheSensorThatWereRecordedComeFirst) {
  const std::string yaml = ReadWholeFile(recording() / "dataset.yaml");
  const std::string channels = "channels:\n";
  WriteWholeFile(
      recording() / "dataset.yaml",
      std::string(yaml).insert(yaml.find(channels) + channels.size(),
                               "  - {path: truth/digger/sensors/eye.csv, type: pose}\n"));
  fs::create_directories(recording() / "truth/digger/sensors");
  WriteWholeFile(recording() / "truth/digger/sensors/eye.csv",
                 "t_ns,x_m,y_m,z_m,qw,qx,qy,qz\n0,100,0,0,1,0,0,0\n1000000000,102,0,0,1,0,0,0\n");
  Export(recording(), scratch_.path() / "out", {.format = ExportFormat::kPcd});
  const std::string pcd = ReadWholeFile(scratch_.path() / "out/map.pcd");
  const std::string points = pcd.substr(pcd.size() - 2 * kPackedBytes);
  EXPECT_TRUE(PackedPlace(points, 0).isApprox(Vec3(103, 0, 0), 1e-6));
  EXPECT_TRUE(PackedPlace(points, kPackedBytes).isApprox(Vec3(105, 0, 0), 1e-6));
}

TEST_F(MapsTest, WithoutAPlaceOfTheLidarThereIsNoMap) {
  EXPECT_THAT([&] { Export(recording(), scratch_.path() / "out", {.format = ExportFormat::kPcd}); },
              ThrowsFault(kMissing));
  EXPECT_FALSE(fs::exists(scratch_.path() / "out.incomplete"));
}

}  // namespace
}  // namespace tera
