#include <gmock/gmock.h>

#include <limits>

#include "dataset/format/pcd.h"
#include "dataset/lint/healthy_recording.h"

// scans.*: each broken by itself.

namespace tera {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr char kScan[] = "digger/lidar/scans/100000000.pcd";

class ScanRules : public LintTest {
 protected:
  void EditPoints(const std::string& file,
                  const std::function<void(std::vector<LidarPoint>*)>& change) const {
    std::vector<LidarPoint> points = ReadPcd(run() / file);
    change(&points);
    Put(file, EncodePcd(points));
  }
};

TEST_F(ScanRules, AScanWithOtherFields) {
  Edit(kScan, "FIELDS x y z", "FIELDS y x z");
  EXPECT_EQ(Only("scans.readable", "digger/lidar").places[0].file, kScan);
}

TEST_F(ScanRules, AScanThatIsCutOff) {
  std::string bytes = ReadWholeFile(run() / kScan);
  bytes.resize(bytes.size() - 3);
  Put(kScan, bytes);
  Only("scans.readable", "digger/lidar");
}

TEST_F(ScanRules, PointsThatAreNowhereOrTooBrightOrTooLate) {
  EditPoints(kScan, [](std::vector<LidarPoint>* points) {
    (*points)[20].x_m = std::numeric_limits<float>::quiet_NaN();
    (*points)[21].intensity = 200;
    (*points)[22].time_offset_ns = 100'000'001;  // a revolution takes 0.1 s
  });
  EXPECT_EQ(Only("scans.values", "digger/lidar").count, 3);
}

TEST_F(ScanRules, AClassThatIsNotListed) {
  EditPoints(kScan, [](std::vector<LidarPoint>* points) { (*points)[20].label = 77; });
  EXPECT_EQ(Only("scans.classes", "digger/lidar").places[0].message, "1 points of class 77");
}

TEST_F(ScanRules, AnInstanceThatIsNotListedOrOfAnotherClass) {
  EditPoints(kScan, [](std::vector<LidarPoint>* points) {
    (*points)[0].instance = 2;
    (*points)[20].instance = 70;
  });
  const LintFinding finding = Only("scans.instances", "digger/lidar");
  ASSERT_EQ(finding.count, 2);
  EXPECT_THAT(finding.places[0].message,
              HasSubstr("have class truck but instance 2 (digger/boom)"));
}

TEST_F(ScanRules, ALidarThatIsMountedElsewhere) {
  // 2 m behind its true place.
  Edit("digger/lidar/sensor.yaml", "xyz_m: [0.9,", "xyz_m: [-1.1,");
  EXPECT_THAT(Only("scans.depth", "digger/lidar").places[0].message, StartsWith("0 of "));
}

TEST_F(ScanRules, DepthIsComparedWhereThereIsNoDistance) {
  for (int k = 0; k <= 10; ++k) {
    const std::string stamp = std::to_string(200'000'000LL * k) + ".png";
    std::filesystem::remove(run() / "digger/front/distance" / stamp);
  }
  EXPECT_TRUE(Found().empty());
  Edit("digger/lidar/sensor.yaml", "xyz_m: [0.9,", "xyz_m: [-1.1,");
  Only("scans.depth", "digger/lidar");
}

TEST_F(ScanRules, RainBeforeASurfaceIsNotHeldAgainstItsDepth) {
  for (const auto& file : std::filesystem::directory_iterator(run() / "digger/lidar/scans")) {
    const std::string scan = "digger/lidar/scans/" + file.path().filename().string();
    EditPoints(scan, [](std::vector<LidarPoint>* points) {
      for (LidarPoint& point : *points) {
        point.x_m *= 0.3f;
        point.y_m *= 0.3f;
        point.z_m *= 0.3f;
        point.label = static_cast<std::uint8_t>(SemanticClass::kRain);
        point.instance = 0;
      }
    });
  }
  EXPECT_FALSE(Found().contains("scans.depth"));
}

}  // namespace
}  // namespace tera
