#include "dataset/compare/receiver_tracks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "dataset/compare/compare.h"
#include "dataset/format/sample_recording.h"
#include "dataset/format/site_frame.h"

namespace tera {
namespace {

using testing::Contains;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr SiteFrame::Geodetic kYard{47, 10, 460};

/// Setting of a recording of a machine's receivers.
struct Made {
  SiteFrame::Geodetic origin = kYard;
  Vec3 shift_m = Vec3::Zero();  ///< of the machine, in the yard
  double turn_rad = 0;          ///< of the machine's heading
  std::vector<std::pair<std::string, Vec3>> antennas = {{"left", Vec3(-0.9, 0.6, 1.2)},
                                                        {"right", Vec3(-0.9, -0.6, 1.2)}};
  bool has_mounts = true;
  std::vector<std::string> links = {};  ///< of the antennas; of more than these, "upper"
  double rate_hz = 10, late_s = 0;
};

/// Drives a level quarter circle of 8 m in 20 s and then 4 m straight on, in the yard's own east,
/// north and up.
Pose MachineAt(double t_s) {
  const double angle_rad = std::min(t_s, 20.0) / 20 * kPi / 2, on_m = std::max(0.0, t_s - 20);
  return MakePose(Vec3(8 * std::sin(angle_rad), 8 - 8 * std::cos(angle_rad) + on_m, 1), 0, 0,
                  angle_rad);
}

void Write(const fs::path& folder, const Made& made) {
  DatasetInfo info = SampleInfo();
  info.simulated = false;
  info.origin_lat_deg = made.origin.lat_deg;
  info.origin_lon_deg = made.origin.lon_deg;
  info.origin_height_m = made.origin.height_m;
  const SiteFrame yard(kYard), own(made.origin);
  DatasetWriter writer(folder, info, {});
  for (std::size_t i = 0; i < made.antennas.size(); ++i) {
    const auto& [name, p_P_m] = made.antennas[i];
    const std::string link = i < made.links.size() ? made.links[i] : "upper";
    const std::string mount = made.has_mounts
                                  ? fmt::format(
                                        "parent_link: {}\nX_parent_sensor: {{xyz_m: [{}, {}, {}], "
                                        "quaternion_wxyz: [1, 0, 0, 0]}}\n",
                                        link, p_P_m.x(), p_P_m.y(), p_P_m.z())
                                  : "";
    const ChannelId gnss = writer.AddChannel(GnssChannel("digger/" + name, "type: gnss\n" + mount));
    for (int k = 0; k <= 24 * made.rate_hz; ++k) {
      const double t_s = k / made.rate_hz;
      const Pose X_WP = MachineAt(t_s + made.late_s) * MakePose(Vec3::Zero(), 0, 0, made.turn_rad);
      const SiteFrame::Geodetic place = yard.ToGeodetic(X_WP * p_P_m + made.shift_m);
      GnssSample sample;
      sample.t_ns = sample.t_available_ns = FromSeconds(t_s);
      sample.lat_deg = place.lat_deg;
      sample.lon_deg = place.lon_deg;
      sample.alt_m = place.height_m;
      sample.enu_m = own.ToEnu(place);
      const bool is_lost = k == 7 && made.rate_hz > 1;
      sample.fix = is_lost ? GnssFix::kNone : GnssFix::kRtkFixed;
      if (is_lost) sample.enu_m = Vec3(1e3, 1e3, 1e3);  // means nothing without a fix
      writer.Write(gnss, RowOf(sample));
    }
  }
  writer.Finish();
}

class ReceiverTracksTest : public testing::Test {
 protected:
  MachineComparison Compared(const Made& a, const Made& b) const {
    for (const auto& [name, made] : {std::pair("a", a), std::pair("b", b)}) {
      fs::remove_all(scratch_.path() / name);
      Write(scratch_.path() / name, made);
    }
    return Compare(scratch_.path() / "a", scratch_.path() / "b").machines.at(0);
  }
  ScratchDirectory scratch_;
};

// Half a metre east and 0.1 m up, and a heading error of 3 deg. The error moves the left antenna,
// 1.0817 m from the axis of rotation, by 2 1.0817 m sin(1.5 deg) = 0.0566 m.
TEST_F(ReceiverTracksTest, ReceiversAloneTellPlaceAndHeading) {
  const MachineComparison same = Compared({}, {.shift_m = Vec3(0.3, 0.4, 0)});
  ASSERT_EQ(same.tracks.size(), 2u);
  EXPECT_EQ(same.tracks[0].of, "left, heading from left to right");
  EXPECT_NEAR(same.tracks[0].unaligned.ape_translation_m.rmse, 0.5, 1e-6);
  EXPECT_NEAR(same.tracks[0].unaligned.ape_rotation_rad.rmse, 0, 1e-6);
  EXPECT_NEAR(same.tracks[0].aligned_se2.ape_translation_m.rmse, 0, 1e-6);
  EXPECT_NEAR(same.tracks[0].unaligned.final_drift_m, 0, 1e-6);
  const MachineComparison turned = Compared({}, {.turn_rad = 3 * kDeg});
  EXPECT_NEAR(turned.tracks[0].unaligned.ape_rotation_rad.rmse, 3 * kDeg, 1e-6);
  EXPECT_NEAR(turned.tracks[0].unaligned.ape_translation_m.rmse,
              2 * std::hypot(0.9, 0.6) * std::sin(1.5 * kDeg), 1e-6);
}

TEST_F(ReceiverTracksTest, OriginsMayDiffer) {
  // 1.1 km north, 0.8 km west and 30 m lower: another origin of the same yard.
  const SiteFrame::Geodetic other{47.01, 9.99, 430};
  const MachineComparison near = Compared({}, {.origin = other, .shift_m = Vec3(0, 0, 0.2)});
  EXPECT_NEAR(near.tracks.at(0).unaligned.ape_translation_m.rmse, 0.2, 1e-6);
  // The same motion at a distant place has its own east, north and up.
  ScratchDirectory scratch;
  Write(scratch.path() / "a", {});
  Write(scratch.path() / "far", {});
  std::string text = ReadWholeFile(scratch.path() / "far/dataset.yaml");
  const std::string origin = "lat_deg: 47";
  text.replace(text.find(origin), origin.size(), "lat_deg: 17");
  WriteWholeFile(scratch.path() / "far/dataset.yaml", text);
  EXPECT_THAT(Compare(scratch.path() / "a", scratch.path() / "far").machines.at(0).remarks,
              Contains(HasSubstr("each recording keeps its own east, north and up")));
}

TEST_F(ReceiverTracksTest, AnAntennaThatSitsElsewhereIsMovedByTheHeading) {
  Made other;
  other.antennas = {{"left", Vec3(-0.4, 0.6, 1.5)}, {"right", Vec3(-0.4, -0.6, 1.5)}};
  const MachineComparison moved = Compared({}, other);
  EXPECT_NEAR(moved.tracks.at(0).unaligned.ape_translation_m.max, 0, 1e-6);
  EXPECT_THAT(moved.remarks, Contains(HasSubstr("the mounts of left differ by 0.583 m")));
  // Without a second antenna no heading is available for the move; a remark says so.
  other.antennas.pop_back();
  Made one;
  one.antennas.pop_back();
  EXPECT_THAT(Compared(one, other).remarks,
              Contains(HasSubstr("the heading of its link is unknown")));
}

TEST_F(ReceiverTracksTest, OfOneReceiverOrOfUnknownPlacesThePathIsCompared) {
  Made one, other;
  one.antennas = {{"gps", Vec3(0, 0, 2)}};
  other.antennas = {{"rover", Vec3(0, 0, 2)}};  // one each: those two
  other.shift_m = Vec3(0, 0, 0.25);
  const MachineComparison single = Compared(one, other);
  ASSERT_EQ(single.tracks.size(), 1u);
  EXPECT_EQ(single.tracks[0].rotation, TrackComparison::Rotation::kNone);
  EXPECT_NEAR(single.tracks[0].unaligned.ape_translation_m.rmse, 0.25, 1e-6);
  EXPECT_NEAR(single.tracks[0].unaligned.path_length_a_m, 4 * kPi + 4, 0.2);
  const Made unknown{.has_mounts = false}, turned{.turn_rad = 3 * kDeg, .has_mounts = false};
  for (const Made& a : {unknown, Made{}}) {
    const MachineComparison headless = Compared(a, turned);
    ASSERT_EQ(headless.tracks.size(), 2u);
    EXPECT_EQ(headless.tracks[0].of, "left");
    EXPECT_EQ(headless.tracks[0].rotation, TrackComparison::Rotation::kNone);
  }
}

// The bucket's antenna comes first, on another link; two on the upper structure give the heading of
// that link only, in either order.
TEST_F(ReceiverTracksTest, AHeadingIsThatOfAntennasOnItsLinkAlone) {
  Made one;
  one.antennas = {{"bucket", Vec3(5, 0.2, 0)},
                  {"left", Vec3(-0.9, 0.6, 1.2)},
                  {"right", Vec3(-0.9, -0.6, 1.2)}};
  one.links = {"bucket"};
  Made other = one;
  other.turn_rad = 3 * kDeg;
  other.antennas[0].second = Vec3(4, 0.2, 0);
  const MachineComparison c = Compared(one, other);
  ASSERT_EQ(c.tracks.size(), 3u);
  EXPECT_EQ(c.tracks[0].of, "bucket");
  EXPECT_EQ(c.tracks[0].rotation, TrackComparison::Rotation::kNone);
  EXPECT_THAT(c.remarks, Contains(HasSubstr("the mounts of bucket differ by 1.000 m")));
  EXPECT_THAT(c.remarks, Contains(HasSubstr("the heading of its link is unknown")));
  for (std::size_t k : {1, 2}) {
    EXPECT_THAT(c.tracks[k].of, HasSubstr("heading from left to right"));
    EXPECT_NEAR(c.tracks[k].unaligned.ape_rotation_rad.rmse, 3 * kDeg, 1e-6);
  }
}

TEST_F(ReceiverTracksTest, ASlowReceiverIsComparedWithAFastOne) {
  const MachineComparison slow = Compared({}, {.rate_hz = 0.5});
  // Chords over 2 s of a circle of 8 m at 0.63 m/s lie 1.26^2 / (8 8) = 0.025 m inside it.
  EXPECT_LT(slow.tracks.at(0).unaligned.ape_translation_m.max, 0.035);
  EXPECT_GT(slow.tracks.at(0).unaligned.ape.size(), 150u);
}

TEST_F(ReceiverTracksTest, TheTableHasPositionsAndTheHeading) {
  Compared({}, {.turn_rad = 3 * kDeg});
  const std::string table = ComparisonTable(Compare(scratch_.path() / "a", scratch_.path() / "b"));
  EXPECT_THAT(table, HasSubstr("antenna left, heading from left to right"));
  EXPECT_THAT(table, HasSubstr("rmse deg"));
  EXPECT_THAT(table, HasSubstr("3.00"));
}

TEST_F(ReceiverTracksTest, WhereNothingCanBeComparedThatIsSaid) {
  Made other;
  other.antennas = {{"front", Vec3(1, 0, 1)}, {"rear", Vec3(-1, 0, 1)}};
  try {
    Compared({}, other);
    FAIL() << "compared";
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("nothing to compare: "));
    EXPECT_THAT(fault.what(), HasSubstr("digger/left (gnss), digger/right (gnss)"));
    EXPECT_THAT(fault.what(), HasSubstr("share no name"));
    EXPECT_THAT(fault.what(), HasSubstr("need poses in both recordings"));
  }
}

}  // namespace
}  // namespace tera
