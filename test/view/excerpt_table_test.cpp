#include <gtest/gtest.h>

#include "view/excerpt_parts.h"
#include "view/small_recording.h"

namespace tera {
namespace {

TEST(ThinnedTable, KeepsHeaderFirstAndLastRow) {
  const std::string csv = "t_ns,x\n0,1\n1,2\n2,3\n3,4\n4,5\n";
  EXPECT_EQ(ThinnedTable(csv, 3), "t_ns,x\n0,1\n2,3\n4,5\n");
  EXPECT_EQ(ThinnedTable(csv, 2), "t_ns,x\n0,1\n4,5\n");
  EXPECT_EQ(ThinnedTable(csv, 5), csv);
  EXPECT_EQ(ThinnedTable("t_ns,x\n", 5), "t_ns,x\n");
}

TEST(FrameList, TakesEachNthFrameWithItsFiles) {
  const std::filesystem::path recording = SmallRecording("frames");
  const FrameList camera(ServedFolder(recording), "digger/camera", {"rgb", "depth"});
  EXPECT_EQ(camera.size(), 2u);
  EXPECT_EQ(camera.Files(1), (std::vector<std::string>{"digger/camera/rgb/0.png",
                                                       "digger/camera/rgb/1000000000.png"}));
  EXPECT_EQ(camera.Files(2), std::vector<std::string>{"digger/camera/rgb/0.png"});
  EXPECT_EQ(camera.Table(2), "t_ns,filename\n0,0.png\n");
  EXPECT_EQ(camera.Bytes(1),
            std::string("first picture").size() + std::string("second picture").size());
  const FrameList lidar(ServedFolder(recording), "digger/lidar", {});
  EXPECT_EQ(lidar.Files(2), std::vector<std::string>{"digger/lidar/scans/0.pcd"});
}

}  // namespace
}  // namespace tera
