#include <gtest/gtest.h>
#include <pcl/io/vlp_grabber.h>
#include <pcl/point_types.h>

#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>
#include <vector>

#include "core/units.h"
#include "dataset/export/export.h"
#include "dataset/format/writer.h"
#include "own_folder.h"

// Packets of this project decoded by the Point Cloud Library.

namespace tera {
namespace {

constexpr int kColumns = 1808, kRings = 16;
constexpr TimeNs kTurn_ns = 100'000'000;

/// Different for each pulse, in whole steps of 2 mm; 0 for one pulse of five.
double RangeOf(int column, int ring) {
  if ((column + ring) % 5 == 0) return 0;
  return 1 + 0.002 * ((37 * column + 101 * ring) % 40'000);
}

/// Ring 0 looks up by 15 deg, each further one 2 deg lower. The lasers that look down fire at even
/// times of 2.304 us, the others between them.
double FiringOf_us(int ring) {
  const int elevation_deg = 15 - 2 * ring;
  return 2.304 * (elevation_deg < 0 ? elevation_deg + 15 : elevation_deg);
}

LidarScan ScanAt(TimeNs t_ns) {
  LidarScan scan{t_ns, t_ns, {}};
  for (int column = 0; column < kColumns; ++column) {
    for (int ring = 0; ring < kRings; ++ring) {
      const double range_m = RangeOf(column, ring), elevation = (15 - 2 * ring) * kDeg;
      if (range_m == 0) continue;
      const double firing_us = FiringOf_us(ring);
      const double azimuth = kPi - 2 * kPi * (column / (1.0 * kColumns) + 1e-5 * firing_us);
      LidarPoint point;
      point.x_m = static_cast<float>(range_m * std::cos(elevation) * std::cos(azimuth));
      point.y_m = static_cast<float>(range_m * std::cos(elevation) * std::sin(azimuth));
      point.z_m = static_cast<float>(range_m * std::sin(elevation));
      point.intensity = static_cast<float>(ring) / 255.0F;
      point.ring = static_cast<std::uint16_t>(ring);
      point.time_offset_ns = static_cast<std::uint32_t>(
          std::llround(1.0 * kTurn_ns * column / kColumns + 1e3 * firing_us));
      scan.points.push_back(point);
    }
  }
  return scan;
}

void RecordVlp16(const std::filesystem::path& folder) {
  std::string elevations, firings;
  for (int ring = 0; ring < kRings; ++ring) {
    elevations += (ring == 0 ? "" : ", ") + std::to_string(15 - 2 * ring);
    firings += (ring == 0 ? "" : ", ") + std::to_string(FiringOf_us(ring));
  }
  DatasetWriter writer(folder, DatasetInfo{.scenario_name = "two turns"}, {});
  const ChannelId lidar = writer.AddChannel(
      {.path = "digger/roof",
       .type = std::string(kLidarChannel),
       .form = ChannelForm::kScans,
       .sensor_yaml = "type: lidar\nname: roof\nrate_hz: 10\nmodel:\n  columns: 1808\n"
                      "  elevation_deg: [" +
                      elevations + "]\n  firing_offset_us: [" + firings + "]\n",
       .columns = {}});
  writer.Write(lidar, ScanAt(0));
  writer.Write(lidar, ScanAt(kTurn_ns));
  writer.Finish();
}

/// The points of the turns that PCL completes, which it passes on from a thread of its own. It
/// plays captures in real time and does not tell their end.
std::vector<pcl::PointXYZI> PointsByPcl(const std::filesystem::path& capture, std::size_t count) {
  std::mutex mutex;
  std::vector<pcl::PointXYZI> points;
  const auto has_all = [&] {
    const std::lock_guard lock(mutex);
    return points.size() >= count;
  };
  pcl::VLPGrabber grabber(capture.string());
  const std::function<void(const pcl::PointCloud<pcl::PointXYZI>::ConstPtr&)> take =
      [&](const pcl::PointCloud<pcl::PointXYZI>::ConstPtr& turn) {
        const std::lock_guard lock(mutex);
        points.insert(points.end(), turn->begin(), turn->end());
      };
  grabber.registerCallback(take);
  grabber.start();
  constexpr int kMostWaits = 600;
  for (int k = 0; k < kMostWaits && !has_all(); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  grabber.stop();
  return points;
}

// A VLP-16 begins a turn forward, at azimuth 0, a scan of TERA behind: PCL completes the half turn
// before, and the turn between. It gives all firings of a sequence one azimuth.
TEST(PacketsJudge, PclFindsEachReturnOfAVlp16) {
  const std::filesystem::path run = OwnFolder() / "run", out = OwnFolder() / "out";
  std::filesystem::remove_all(run);
  std::filesystem::remove_all(out);
  RecordVlp16(run);
  Export(run, out, {.format = ExportFormat::kPcap});
  std::size_t expected = 0;
  for (int column = 0; column < 3 * kColumns / 2; ++column) {
    for (int ring = 0; ring < kRings; ++ring) {
      if (RangeOf(column % kColumns, ring) > 0) ++expected;
    }
  }
  const auto points = PointsByPcl(out / "digger/roof.pcap", expected);
  EXPECT_EQ(points.size(), expected);
  for (const pcl::PointXYZI& p : points) {
    const double range_m = std::hypot(p.x, p.y, p.z);
    const double ring = (15 - std::asin(p.z / range_m) / kDeg) / 2;
    ASSERT_NEAR(ring, std::round(ring), 1e-3);
    // PCL's x points to the right and its y forward.
    const double turned_deg = std::atan2(p.x, p.y) / kDeg + 180;
    const double column = turned_deg / 360 * kColumns;
    const int nearest = static_cast<int>(std::lround(column)) % kColumns;
    ASSERT_NEAR(column, std::lround(column), 0.08);  // 0.015 deg
    ASSERT_NEAR(range_m, RangeOf(nearest, static_cast<int>(std::lround(ring))), 1e-4);
    ASSERT_EQ(p.intensity, std::lround(ring));
  }
}

}  // namespace
}  // namespace tera
