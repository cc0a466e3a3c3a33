#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include "dataset/files/checked_file.h"
#include "dataset/format/pcd.h"
#include "dataset/import/cloud/read_point_cloud.h"
#include "own_folder.h"

// Files of this project read by the Point Cloud Library, and the reverse.

namespace tera {
namespace {

std::string File(const std::string& name) { return (OwnFolder() / name).string(); }

std::vector<LidarPoint> Scan() {
  std::vector<LidarPoint> points;
  for (int k = 0; k < 500; ++k) {
    LidarPoint point;
    point.x_m = 0.25F * static_cast<float>(k);
    point.y_m = -3.5F + static_cast<float>(k % 7);
    point.z_m = 1.0F / static_cast<float>(k + 1);
    point.intensity = 0.5F;
    point.time_offset_ns = static_cast<std::uint32_t>(1000 * k);
    point.ring = static_cast<std::uint16_t>(k % 16);
    points.push_back(point);
  }
  return points;
}

TEST(PcdJudge, PclReadsTheScansOfADatasetToTheBit) {
  const std::vector<LidarPoint> written = Scan();
  WriteWholeFile(File("scan.pcd"), EncodePcd(written));
  pcl::PointCloud<pcl::PointXYZI> read;
  ASSERT_EQ(pcl::io::loadPCDFile(File("scan.pcd"), read), 0);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < written.size(); ++k) {
    EXPECT_EQ(read[k].x, written[k].x_m);
    EXPECT_EQ(read[k].y, written[k].y_m);
    EXPECT_EQ(read[k].z, written[k].z_m);
    EXPECT_EQ(read[k].intensity, written[k].intensity);
  }
}

TEST(PcdJudge, EveryFormThatPclWritesIsRead) {
  pcl::PointCloud<pcl::PointXYZINormal> cloud;
  for (int k = 0; k < 300; ++k) {
    pcl::PointXYZINormal point;
    point.x = 0.5F * static_cast<float>(k);
    point.y = -1.25F * static_cast<float>(k);
    point.z = static_cast<float>(k % 11);
    point.intensity = 7;
    cloud.push_back(point);
  }
  cloud[17].z = std::numeric_limits<float>::quiet_NaN();
  cloud.is_dense = false;
  pcl::io::savePCDFileASCII(File("ascii.pcd"), cloud);
  pcl::io::savePCDFileBinary(File("binary.pcd"), cloud);
  pcl::io::savePCDFileBinaryCompressed(File("packed.pcd"), cloud);
  for (const char* name : {"ascii.pcd", "binary.pcd", "packed.pcd"}) {
    const PointCloud read = ReadPointCloud(File(name));
    ASSERT_EQ(read.p_m.size(), cloud.size() - 1) << name;
    EXPECT_EQ(read.without_place, 1) << name;
    for (std::size_t k = 0; k < read.p_m.size(); ++k) {
      const auto& point = cloud[k < 17 ? k : k + 1];
      EXPECT_EQ(read.p_m[k], Vec3(point.x, point.y, point.z)) << name << " " << k;
    }
  }
}

TEST(PcdJudge, PlyOfPclIsRead) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int k = 0; k < 50; ++k) {
    cloud.push_back(pcl::PointXYZ(0.5F * static_cast<float>(k), 2, -static_cast<float>(k)));
  }
  pcl::io::savePLYFileASCII(File("ascii.ply"), cloud);
  pcl::io::savePLYFileBinary(File("binary.ply"), cloud);
  for (const char* name : {"ascii.ply", "binary.ply"}) {
    const PointCloud read = ReadPointCloud(File(name));
    ASSERT_EQ(read.p_m.size(), cloud.size()) << name;
    EXPECT_EQ(read.p_m[49], Vec3(24.5, 2, -49)) << name;
  }
}

}  // namespace
}  // namespace tera
