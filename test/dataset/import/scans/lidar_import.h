#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/scans/packets_by_hand.h"

namespace tera {

/// Imports a mapping of one lidar.
class LidarImportTest : public ::testing::Test {
 protected:
  void File(const std::string& name, const std::string& bytes) {
    WriteWholeFile(scratch_.path() / name, bytes);
  }
  ImportReport Import(const std::string& lidar, const std::string& more = "",
                      const ImportOptions& options = {}) {
    File("mapping.yaml",
         "name: logged\nmachine: digger\n" + more + "lidars: [{name: roof, " + lidar + "}]\n");
    std::filesystem::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
  void ExpectFault(const std::string& lidar, FaultKind kind, const std::string& place) {
    EXPECT_THAT([&] { Import(lidar); }, ThrowsFault(kind, place)) << lidar;
    EXPECT_FALSE(std::filesystem::exists(Out()));
    EXPECT_FALSE(std::filesystem::exists(Out().string() + ".incomplete"));
  }
  std::vector<LidarScan> Scans() const {
    const Recording recording(Out());
    std::vector<LidarScan> scans;
    for (const TimeNs t_ns : recording.FrameTimes("digger/roof")) {
      scans.push_back(recording.LoadScan("digger/roof", t_ns));
    }
    return scans;
  }
  std::filesystem::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

inline Vec3 PlaceOf(const LidarPoint& point) { return {point.x_m, point.y_m, point.z_m}; }

inline void ExpectPlace(const LidarPoint& point, const Vec3& p_m, double tolerance_m = 1e-5) {
  EXPECT_LT((PlaceOf(point) - p_m).norm(), tolerance_m)
      << PlaceOf(point).transpose() << " need " << p_m.transpose();
}

}  // namespace tera
