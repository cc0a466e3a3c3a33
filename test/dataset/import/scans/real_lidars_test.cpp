#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include "core/units.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"

// Packets of real lidars, in the folder of TERA_RECORDINGS, against results of other projects:
// lidar_velodyne and lidar_hesai against clouds by tier4/nebula, lidar_ouster against plain counts.

namespace tera {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

const fs::path kRecordings = TERA_RECORDINGS;

class RealLidar : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(kRecordings)) GTEST_SKIP() << "no recordings in " << kRecordings;
  }
  ImportReport Import(const std::string& file, const std::string& lidar) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   fmt::format("name: real\nmachine: digger\nzero: start\nlidars: [{{name: roof, "
                               "file: {}, {}}}]\n",
                               (kRecordings / file).string(), lidar));
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out());
  }
  std::vector<LidarScan> Scans() const {
    const Recording recording(Out());
    std::vector<LidarScan> scans;
    for (const TimeNs t_ns : recording.FrameTimes("digger/roof")) {
      scans.push_back(recording.LoadScan("digger/roof", t_ns));
    }
    return scans;
  }
  fs::path Out() const { return scratch_.path() / "out"; }
  const ScratchDirectory scratch_;
};

/// The places of another project's cloud: floats x, y, z at the start of each record.
std::vector<Vec3> CloudOf(const fs::path& file) {
  const std::string bytes = ReadWholeFile(file);
  const std::string last = "DATA binary\n";
  const std::size_t body = bytes.find(last) + last.size();
  std::istringstream lines(bytes.substr(0, body));
  std::size_t step = 0, count = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "POINTS") words >> count;
    for (std::size_t size = 0; key == "SIZE" && words >> size;) step += size;
  }
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < count; ++k) {
    float p[3];
    std::memcpy(p, bytes.data() + body + k * step, sizeof p);
    places.emplace_back(p[0], p[1], p[2]);
  }
  return places;
}

/// Finds points nearby.
class Grid {
 public:
  Grid(const std::vector<Vec3>& places, double reach_m) : places_(places), reach_m_(reach_m) {
    for (std::size_t k = 0; k < places.size(); ++k) cells_[CellOf(places[k])].push_back(k);
  }
  bool HasNear(const Vec3& p_m) const {
    const auto [x, y, z] = CellOf(p_m);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto cell = cells_.find({x + dx, y + dy, z + dz});
          if (cell == cells_.end()) continue;
          for (const std::size_t k : cell->second) {
            if ((places_[k] - p_m).norm() <= reach_m_) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::tuple<int, int, int>;
  Cell CellOf(const Vec3& p_m) const {
    const auto of = [&](double v) { return static_cast<int>(std::floor(v / reach_m_)); };
    return {of(p_m.x()), of(p_m.y()), of(p_m.z())};
  }
  const std::vector<Vec3>& places_;
  double reach_m_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

/// Share of the other project's points that have one of ours within `reach_m`.
double ShareFound(const std::vector<Vec3>& theirs, const std::vector<Vec3>& ours, double reach_m) {
  const Grid grid(ours, reach_m);
  const auto found = std::count_if(theirs.begin(), theirs.end(),
                                   [&](const Vec3& p_m) { return grid.HasNear(p_m); });
  return static_cast<double>(found) / static_cast<double>(theirs.size());
}

std::vector<Vec3> PlacesOf(const LidarScan& scan) {
  std::vector<Vec3> places;
  for (const LidarPoint& p : scan.points) places.emplace_back(p.x_m, p.y_m, p.z_m);
  return places;
}

/// Best share over the scans that the other project's cloud may contain: its first or last points
/// belong to the neighbouring turns.
double BestShare(const std::vector<Vec3>& theirs, const std::vector<std::vector<Vec3>>& scans) {
  constexpr double kReach_m = 0.01;
  double best = 0;
  for (std::size_t k = 0; k + 1 < scans.size(); ++k) {
    std::vector<Vec3> two = scans[k];
    two.insert(two.end(), scans[k + 1].begin(), scans[k + 1].end());
    best = std::max(best, ShareFound(theirs, two, kReach_m));
  }
  return best;
}

/// A point rotated to a larger azimuth, clockwise from above.
Vec3 TurnedOn(const Vec3& p_m, double degrees) {
  return Eigen::AngleAxisd(-degrees * kDeg, Vec3::UnitZ()) * p_m;
}

TEST_F(RealLidar, AVlp16IsDecodedAsByAnotherProject) {
  const auto theirs = CloudOf(kRecordings / "lidar_velodyne/1673400472138016708.pcd");
  ASSERT_EQ(theirs.size(), 14831u);
  Import("lidar_velodyne/1673400471837873222_0.db3",
         "topic: /velodyne_packets, unit: vlp16, returns: all");
  // Nebula ignores the beams' height above or below the origin. The manual states it: from 11.2 mm
  // of the lowest to -11.2 mm of the highest ring. In the last blocks of a packet it uses the
  // block's azimuth for all firings, for second returns that of the next block.
  constexpr double kUp_m[] = {-0.0112, -0.0097, -0.0081, -0.0066, -0.0051, -0.0037,
                              -0.0022, -0.0007, 0.0007,  0.0022,  0.0037,  0.0051,
                              0.0066,  0.0081,  0.0097,  0.0112};
  constexpr int kLaserOfRing[] = {15, 13, 11, 9, 7, 5, 3, 1, 14, 12, 10, 8, 6, 4, 2, 0};
  constexpr double kBlock_us = 110.592, kBlock_deg = 360 / 0.1002 * kBlock_us * 1e-6;
  std::vector<std::vector<Vec3>> as_they_are, turned;
  for (const LidarScan& scan : Scans()) {
    as_they_are.push_back(PlacesOf(scan));
    turned.emplace_back();
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      Vec3& p_m = as_they_are.back()[k];
      p_m.z() -= kUp_m[scan.points[k].ring];
      turned.back().push_back(p_m);
      for (const double sequence_us : {0.0, kBlock_us / 2}) {
        const double since_us = sequence_us + 2.304 * kLaserOfRing[scan.points[k].ring];
        const double since_deg = kBlock_deg * since_us / kBlock_us;
        turned.back().push_back(TurnedOn(p_m, -since_deg));
        turned.back().push_back(TurnedOn(p_m, kBlock_deg - since_deg));
      }
    }
  }
  const double as_is = BestShare(theirs, as_they_are), share = BestShare(theirs, turned);
  RecordProperty("within 1 cm as they are", fmt::format("{:.5f}", as_is));
  RecordProperty("within 1 cm", fmt::format("{:.5f}", share));
  EXPECT_GE(as_is, 0.97);
  EXPECT_GE(share, 0.999);
}

TEST_F(RealLidar, AVlp32cIsDecodedAsByAnotherProject) {
  const auto theirs = CloudOf(kRecordings / "lidar_velodyne/vlp32_1713492677464078412.pcd");
  ASSERT_EQ(theirs.size(), 26216u);
  Import("lidar_velodyne/vlp32_1713492677464078412_0.db3",
         "topic: /sensing/lidar/front/velodyne_packets, unit: vlp32c");
  // Nebula advances the azimuth by one firing for each laser, and not at all in the last block of a
  // packet. By the manual two lasers fire at once, so that laser n has turned by n / 2 firings.
  constexpr int kLaserOfRing[] = {29, 30, 25, 26, 21, 22, 17, 13, 18, 14, 9,  5, 10, 6, 1, 31,
                                  2,  28, 27, 23, 24, 20, 19, 15, 16, 12, 11, 8, 7,  4, 3, 0};
  constexpr double kFiring_deg = 360 / 0.1001 * 2.304e-6;
  std::vector<std::vector<Vec3>> as_they_are, turned;
  for (const LidarScan& scan : Scans()) {
    as_they_are.push_back(PlacesOf(scan));
    turned.emplace_back();
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const int laser = kLaserOfRing[scan.points[k].ring], pair = laser / 2;
      const Vec3& p_m = as_they_are.back()[k];
      turned.back().push_back(TurnedOn(p_m, (laser - pair) * kFiring_deg));
      turned.back().push_back(TurnedOn(p_m, -pair * kFiring_deg));
    }
  }
  const double share = BestShare(theirs, turned);
  RecordProperty("within 1 cm as they are", fmt::format("{:.5f}", BestShare(theirs, as_they_are)));
  RecordProperty("within 1 cm", fmt::format("{:.5f}", share));
  EXPECT_GE(share, 0.999);
}

TEST_F(RealLidar, AQt64IsDecodedAsByAnotherProject) {
  auto theirs = CloudOf(kRecordings / "lidar_hesai/1673401196087570870.pcd");
  ASSERT_EQ(theirs.size(), 34158u);
  for (Vec3& p_m : theirs) p_m = Vec3(p_m.y(), -p_m.x(), p_m.z());  // its y is forward
  Import("lidar_hesai/1673401195788312575_0.db3",
         "topic: /pandar_packets, unit: qt64, returns: all");
  std::vector<std::vector<Vec3>> scans;
  for (const LidarScan& scan : Scans()) scans.push_back(PlacesOf(scan));
  const double share = BestShare(theirs, scans);
  RecordProperty("within 1 cm", fmt::format("{:.5f}", share));
  EXPECT_GE(share, 0.999);
}

TEST_F(RealLidar, AnOs0OfTwoReturnsHasThePixelsThatAPlainCountFinds) {
  const std::string stem = "lidar_ouster/OS-0-32-U1_v2.2.0_1024x10";
  const std::string keys = fmt::format("metadata: {}", (kRecordings / (stem + ".json")).string());
  const ImportReport report = Import(stem + ".pcap", keys);
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 1u);
  // 34 % of 32 times 1024 pixels have no first return: 21 631 have one. 115 of the others have only
  // a second return.
  EXPECT_EQ(scans[0].points.size(), 21631u + 115u);
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("33.6 % of the rays")));
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("57 second returns")));
  std::vector<float> reflectivities;
  for (const LidarPoint& p : scans[0].points) reflectivities.push_back(255 * p.intensity);
  std::sort(reflectivities.begin(), reflectivities.end());
  const auto quartile = [&](int k) {
    return std::lround(reflectivities[reflectivities.size() * static_cast<std::size_t>(k) / 4]);
  };
  EXPECT_EQ(quartile(1), 6);
  EXPECT_EQ(quartile(2), 10);
  EXPECT_EQ(quartile(3), 27);
  Import(stem + ".pcap", keys + ", returns: all");
  const auto points = Scans()[0].points;
  ASSERT_EQ(points.size(), 21631u + 115u + 57u);
  // The closest second return is 167 mm behind the first.
  double closest_m = 100;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const LidarPoint &a = points[k - 1], &b = points[k];
    if (a.ring != b.ring || a.time_offset_ns != b.time_offset_ns) continue;
    closest_m = std::min(
        closest_m, static_cast<double>(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m)));
  }
  EXPECT_NEAR(closest_m, 0.167, 0.0005);
}

TEST_F(RealLidar, AnOs1OfLowBandwidthHasThePixelsThatAPlainCountFinds) {
  const std::string stem = "lidar_ouster/OS-1-128_v2.3.0_1024x10";
  Import(stem + "_lb_n3.pcap",
         fmt::format("metadata: {}", (kRecordings / (stem + ".json")).string()));
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 3u);
  // Plain counts over the file's bytes: pixels whose range is not 0, frame by frame.
  constexpr std::size_t kCounts[] = {107647, 107357, 107532};
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(scans[n].points.size(), kCounts[n]);
  // Turns of 100 ms, by the unit's own clock.
  for (std::size_t n = 1; n < 3; ++n) {
    EXPECT_NEAR(ToSeconds(scans[n].t_ns - scans[n - 1].t_ns), 0.1, 0.001);
  }
}

TEST_F(RealLidar, APartOfAFrameOfFunctionalSafetyComesInAsAPart) {
  const std::string stem = "lidar_ouster/OS-1-128_767798045_1024x10_20230712_120049";
  const ImportReport report = Import(
      stem + ".pcap", fmt::format("metadata: {}", (kRecordings / (stem + ".json")).string()));
  EXPECT_FALSE(Scans().empty());
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("less than a turn")));
}

}  // namespace
}  // namespace tera
