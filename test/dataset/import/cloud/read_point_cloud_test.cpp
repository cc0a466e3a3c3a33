#include "dataset/import/cloud/read_point_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

// Point clouds in files made byte by byte, by the formats' descriptions.

namespace tera {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::filesystem::path Write(const std::string& name, const std::string& bytes) {
  WriteWholeFile(OwnFolder() / name, bytes);
  return OwnFolder() / name;
}

template <typename T>
std::string Raw(T value, bool swapped = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string FaultOf(const std::string& name, const std::string& bytes) {
  try {
    ReadPointCloud(Write(name, bytes));
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr(name));
    return e.what();
  }
  return "no error";
}

const std::string kPcd =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y normal z\nSIZE 1 8 8 4 4\nTYPE U F F F F\n"
    "COUNT 3 1 1 2 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 5 6 7 1 0 0 0\nPOINTS 2\nDATA ";

TEST(PointCloudFile, PcdFieldsAreFoundAmongOthersAndTheViewpointMovesNothing) {
  std::string body;
  for (const double shift : {0.0, 10.0}) {
    body += "abc" + Raw(1.5 + shift) + Raw(-2.25 + shift) + Raw(9.0F) + Raw(9.0F) +
            Raw(static_cast<float>(0.125 + shift));
  }
  EXPECT_THAT(ReadPointCloud(Write("a.pcd", kPcd + "binary\n" + body)).p_m,
              ElementsAre(Vec3(1.5, -2.25, 0.125), Vec3(11.5, 7.75, 10.125)));
  EXPECT_THAT(ReadPointCloud(
                  Write("b.pcd", kPcd + "ascii\n1 2 3 1.5 -2.25 9 9 0.125\n1 2 3 4 5 6 7 8e-1\n"))
                  .p_m,
              ElementsAre(Vec3(1.5, -2.25, 0.125), Vec3(4, 5, 0.8)));
}

TEST(PointCloudFile, PointsWithoutAPlaceAreLeftOutAndCounted) {
  const PointCloud cloud =
      ReadPointCloud(Write("nan.pcd", kPcd + "ascii\n0 0 0 nan 1 0 0 1\n0 0 0 1 2 0 0 3\n"));
  EXPECT_THAT(cloud.p_m, ElementsAre(Vec3(1, 2, 3)));
  EXPECT_EQ(cloud.without_place, 1);
  EXPECT_THAT(FaultOf("nans.pcd", kPcd + "ascii\n0 0 0 nan 1 0 0 1\n0 0 0 1 inf 0 0 3\n"),
              HasSubstr("no point is usable (2 without finite coordinates"));
}

std::string PlyHeader(const std::string& form, const std::string& type) {
  return "ply\r\nformat " + form +
         " 1.0\r\ncomment none\r\nelement vertex 2\r\nproperty uchar red\r\n" + "property " + type +
         " z\r\nproperty " + type + " x\r\nproperty " + type +
         " y\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n";
}

TEST(PointCloudFile, PlyOfEachFormIsRead) {
  std::string little, big;
  for (const double v : {0.0, 100.0}) {
    little += "r" + Raw(3.5 + v) + Raw(1.0 + v) + Raw(2.0 + v);
    big += "r";
    for (const float f : {3.5F, 1.0F, 2.0F}) big += Raw(f + static_cast<float>(v), true);
  }
  const auto both = ElementsAre(Vec3(1, 2, 3.5), Vec3(101, 102, 103.5));
  EXPECT_THAT(
      ReadPointCloud(Write("l.ply", PlyHeader("binary_little_endian", "double") + little)).p_m,
      both);
  EXPECT_THAT(ReadPointCloud(Write("b.ply", PlyHeader("binary_big_endian", "float32") + big)).p_m,
              both);
  EXPECT_THAT(ReadPointCloud(Write("a.ply", PlyHeader("ascii", "float") +
                                                "1 3.5 1 2\n1 103.5 101 102\n3 0 1 1\n"))
                  .p_m,
              both);
}

/// Contents of a LAS file.
struct Las {
  int minor = 2;
  std::uint8_t format = 1;
  std::uint16_t record = 28;
  std::string records;  ///< variable length records
  std::uint32_t record_count = 0;
  std::string points;
  std::uint64_t count = 0;
  std::string extended;  ///< after the points
  std::uint32_t extended_count = 0;
};

/// The public header block of LAS R15, table by table, with scale 0.01, 0.01, 0.001 and offset
/// 500000, 5200000, 400.
std::string Bytes(const Las& las) {
  const std::uint16_t header = las.minor >= 4 ? 375 : 227;
  std::string bytes = "LASF" + std::string(20, '\0');
  bytes += static_cast<char>(1);
  bytes += static_cast<char>(las.minor);
  bytes += std::string(64, ' ') + std::string(4, '\0');
  const auto first = static_cast<std::uint32_t>(header + las.records.size());
  bytes += Raw(header) + Raw(first) + Raw(las.record_count) + Raw(las.format) + Raw(las.record);
  bytes += Raw(static_cast<std::uint32_t>(las.minor >= 4 ? 0 : las.count)) + std::string(20, '\0');
  bytes += Raw(0.01) + Raw(0.01) + Raw(0.001) + Raw(500000.0) + Raw(5200000.0) + Raw(400.0);
  bytes += std::string(48, '\0');
  if (las.minor >= 4) {
    bytes += std::string(8, '\0') + Raw(static_cast<std::uint64_t>(first + las.points.size())) +
             Raw(las.extended_count) + Raw(las.count) + std::string(120, '\0');
  }
  return bytes + las.records + las.points + las.extended;
}

std::string LegacyPoint(std::int32_t x, std::int32_t y, std::int32_t z, std::uint8_t kind) {
  return Raw(x) + Raw(y) + Raw(z) + std::string(3, '\0') + Raw(kind) + std::string(12, '\0');
}

std::string Record(std::uint16_t id, const std::string& body) {
  std::string user = "LASF_Projection";
  user.resize(16, '\0');
  return std::string(2, '\0') + user + Raw(id) + Raw(static_cast<std::uint16_t>(body.size())) +
         std::string(32, '\0') + body;
}

std::string Keys(std::initializer_list<std::uint16_t> numbers) {
  std::string body;
  for (const std::uint16_t number : numbers) body += Raw(number);
  return Record(34735, body);
}

TEST(PointCloudFile, LasPlacesAreOffsetPlusScaleTimesNumber) {
  Las las;
  las.points = LegacyPoint(12345, -100, 2500, 2) + LegacyPoint(0, 0, -1, 5);
  las.count = 2;
  const PointCloud cloud = ReadPointCloud(Write("a.las", Bytes(las)));
  ASSERT_EQ(cloud.p_m.size(), 2u);
  EXPECT_NEAR((cloud.p_m[0] - Vec3(500123.45, 5199999.0, 402.5)).norm(), 0, 1e-8);
  EXPECT_NEAR((cloud.p_m[1] - Vec3(500000, 5200000, 399.999)).norm(), 0, 1e-8);
  EXPECT_EQ(cloud.map, "");
  EXPECT_EQ(cloud.step_m, Vec3(0.01, 0.01, 0.001));
}

TEST(PointCloudFile, LasNoiseAndWithheldPointsAreLeftOut) {
  Las las;
  las.points = LegacyPoint(1, 1, 1, 7) + LegacyPoint(2, 2, 2, 2) + LegacyPoint(3, 3, 3, 0x82);
  las.count = 3;
  const PointCloud cloud = ReadPointCloud(Write("n.las", Bytes(las)));
  EXPECT_EQ(cloud.p_m.size(), 1u);
  EXPECT_EQ(cloud.marked, 2);
}

TEST(PointCloudFile, Las14HasItsCountsFlagsAndClassesElsewhere) {
  Las las;
  las.minor = 4;
  las.format = 6;
  las.record = 32;  // two extra bytes after the format's 30
  const auto point = [](std::int32_t x, std::uint8_t flags, std::uint8_t kind) {
    return Raw(x) + Raw(std::int32_t{0}) + Raw(std::int32_t{0}) + std::string(3, '\0') +
           Raw(flags) + Raw(kind) + std::string(15, '\0');
  };
  las.points = point(100, 0, 2) + point(200, 4, 2) + point(300, 0, 18) + point(400, 0, 64);
  las.count = 4;
  std::string user = "LASF_Projection";
  user.resize(16, '\0');
  const std::string wkt = "PROJCS[\"x\"]";
  las.extended = std::string(2, '\0') + user + Raw(std::uint16_t{2112}) +
                 Raw(static_cast<std::uint64_t>(wkt.size())) + std::string(32, '\0') + wkt;
  las.extended_count = 1;
  const PointCloud cloud = ReadPointCloud(Write("b.las", Bytes(las)));
  ASSERT_EQ(cloud.p_m.size(), 2u);
  EXPECT_NEAR(cloud.p_m[0].x(), 500001, 1e-8);
  EXPECT_NEAR(cloud.p_m[1].x(), 500004, 1e-8);
  EXPECT_EQ(cloud.marked, 2);
  EXPECT_EQ(cloud.map, wkt);
}

TEST(PointCloudFile, LasNamesItsReferenceSystemByKeysOrByText) {
  Las las;
  las.points = LegacyPoint(1, 1, 1, 2);
  las.count = 1;
  las.records = Keys({1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32632});
  las.record_count = 1;
  EXPECT_EQ(ReadPointCloud(Write("k.las", Bytes(las))).map, "EPSG:32632");
  las.records += Record(2112, std::string("LOCAL_CS[\"here\"]") + '\0');
  las.record_count = 2;
  EXPECT_EQ(ReadPointCloud(Write("w.las", Bytes(las))).map, "LOCAL_CS[\"here\"]");
  las.records = Keys({1, 1, 0, 2, 2048, 0, 1, 4326, 3072, 0, 1, 32767});
  las.record_count = 1;
  EXPECT_EQ(ReadPointCloud(Write("u.las", Bytes(las))).map, "one of GeoTIFF keys without a code");
  las.records = Keys({1, 1, 0, 1, 4099, 0, 1, 9003});
  las.record_count = 1;
  EXPECT_THAT(FaultOf("feet.las", Bytes(las)), HasSubstr("heights are in EPSG unit 9003"));
}

TEST(PointCloudFile, WhatIsCutOffIsRefusedWhereverItEnds) {
  Las las;
  las.points = LegacyPoint(1, 1, 1, 2) + LegacyPoint(2, 2, 2, 2);
  las.count = 2;
  las.records = Keys({1, 1, 0, 1, 3072, 0, 1, 32632});
  las.record_count = 1;
  const std::string whole = Bytes(las);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THAT(FaultOf("cut.las", whole.substr(0, length)),
                testing::AnyOf(HasSubstr("cut off"), HasSubstr("does not begin with 'LASF'")))
        << length;
  }
  const std::string pcd = kPcd + "binary\n" + std::string(2 * 31, 'x');
  const std::string ply = PlyHeader("binary_little_endian", "double") + std::string(2 * 25, 'x');
  for (std::size_t length = 0; length < pcd.size(); ++length) {
    EXPECT_THAT(FaultOf("cut.pcd", pcd.substr(0, length)), HasSubstr("cut off")) << length;
  }
  for (std::size_t length = 0; length < ply.size(); ++length) {
    EXPECT_THAT(FaultOf("cut.ply", ply.substr(0, length)),
                testing::AnyOf(HasSubstr("cut off"), HasSubstr("does not begin with 'ply'")))
        << length;
  }
}

TEST(PointCloudFile, WhatIsNoPointCloudIsRefusedWithWhatIsNeeded) {
  EXPECT_THAT(FaultOf("text.las", "easting,northing\n1,2\n"),
              HasSubstr("does not begin with 'LASF', the signature of LAS"));
  EXPECT_THAT(FaultOf("pointer.las", "version https://git-lfs.github.com/spec/v1\noid sha256:4d"),
              HasSubstr("is a pointer of Git LFS instead of the file; need a point cloud as "
                        ".pcd, .ply or .las; fetch the file itself: git lfs pull"));
  EXPECT_THAT(FaultOf("packed.laz", "LASF"), HasSubstr("LAZ is compressed; write it as LAS"));
  EXPECT_THAT(FaultOf("points.xyz", "1 2 3\n"),
              HasSubstr("'.xyz' is an unknown extension of a point cloud; need .pcd"));
  Las las;
  las.format = 0x80 | 1;
  EXPECT_THAT(FaultOf("laz.las", Bytes(las)), HasSubstr("its points are packed as LAZ"));
  las.format = 11;
  EXPECT_THAT(FaultOf("f.las", Bytes(las)), HasSubstr("point format 11 found, need 0 to 10"));
  las.format = 1;
  las.record = 20;
  EXPECT_THAT(FaultOf("r.las", Bytes(las)), HasSubstr("20 bytes long, format 1 needs 28"));
  las.record = 28;
  EXPECT_THAT(FaultOf("zero.las", Bytes(las)), HasSubstr("no point is usable"));
  las.count = 4'000'000'000;
  EXPECT_THAT(FaultOf("many.las", Bytes(las)), HasSubstr("4000000000 points declared"));
}

TEST(PointCloudFile, HeadersThatContradictThemselvesAreRefused) {
  const auto edited = [](std::string from, const std::string& to) {
    std::string text = kPcd + "ascii\n1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8\n";
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(FaultOf("p.pcd", edited("POINTS 2", "POINTS 3")),
              HasSubstr("3 POINTS are not WIDTH 2 times HEIGHT 1"));
  EXPECT_THAT(FaultOf("p.pcd", edited("TYPE U F", "TYPE U")), HasSubstr("4 TYPE"));
  EXPECT_THAT(FaultOf("p.pcd", edited("FIELDS rgb x", "FIELDS rgb w")),
              HasSubstr("has no field 'x'"));
  EXPECT_THAT(FaultOf("p.pcd", edited("TYPE U F", "TYPE U I")),
              HasSubstr("field 'x' is 1 times I8"));
  EXPECT_THAT(FaultOf("p.pcd", edited("WIDTH 2", "WIDTH two")), HasSubstr("found 'two'"));
  EXPECT_THAT(FaultOf("p.pcd", edited("SIZE 1", "SIZE 99")), HasSubstr("field 'rgb'"));
  EXPECT_THAT(FaultOf("p.pcd", edited("8\n1 2", "8 9\n1 2")), HasSubstr("point 1 has 9 numbers"));
  EXPECT_THAT(FaultOf("p.pcd", edited("ascii", "binary_packed")), HasSubstr("DATA is"));
  EXPECT_THAT(FaultOf("p.ply", PlyHeader("binary_middle_endian", "float") + std::string(26, 'x')),
              HasSubstr("its format is 'binary_middle_endian'"));
  EXPECT_THAT(FaultOf("p.ply", "ply\nformat ascii 1.0\nelement face 1\n"),
              HasSubstr("element 'face' comes before its vertices"));
  EXPECT_THAT(
      FaultOf("p.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int a\n"),
      HasSubstr("a property of type 'list'"));
  EXPECT_THAT(FaultOf("p.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                      "y\nend_header\n"),
              HasSubstr("no property 'z'"));
}

}  // namespace
}  // namespace tera
