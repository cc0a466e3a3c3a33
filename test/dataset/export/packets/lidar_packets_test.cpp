#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/faults.h"
#include "core/units.h"
#include "dataset/export/export.h"
#include "dataset/export/packets/lidar_pattern.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/scans/ouster_sheet.h"
#include "dataset/import/scans/packets_by_hand.h"

// Packets of lidars: bytes by the vendors' manuals, and scans that come back by `tera import`.

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A preset of config/sensors as the `model` of a sensor.yaml. The last of equal keys in `more`
/// replaces the preset's.
std::string SheetOf(const std::string& preset,
                    const std::map<std::string, std::string>& more = {}) {
  std::istringstream lines(
      ReadWholeFile(fs::path(TERA_SOURCE_DIR) / "config/sensors" / (preset + ".yaml")));
  std::string sheet, model = "model:\n";
  bool is_replaced = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    if (!line.starts_with(" ")) is_replaced = more.contains(line.substr(0, line.find(':')));
    if (is_replaced) continue;
    const bool is_model = !line.starts_with("type:") && !line.starts_with("rate_hz:");
    (is_model ? model : sheet) += (is_model ? "  " : "") + line + "\n";
  }
  for (const auto& [key, value] : more) {
    if (!value.empty())
      (key == "rate_hz" ? sheet : model) +=
          (key == "rate_hz" ? "" : "  ") + key + ": " + value + "\n";
  }
  return sheet + "name: roof\n" + model;
}

/// A beam of a unit, as its data sheet has it: azimuths turn clockwise.
struct Beam {
  std::uint16_t ring = 0;
  double elevation_deg = 0, clockwise_deg = 0, firing_us = 0;
};

/// A return at 10 Hz. A revolution starts at -x and turns clockwise.
LidarPoint PointOf(const Beam& beam, int column, int columns, double range_m, float intensity) {
  const double turned_deg = 360.0 * (column / static_cast<double>(columns) + 1e-5 * beam.firing_us);
  const double azimuth = (180 - turned_deg - beam.clockwise_deg) * kDeg;
  const double level_m = range_m * std::cos(beam.elevation_deg * kDeg);
  LidarPoint point;
  point.x_m = static_cast<float>(level_m * std::cos(azimuth));
  point.y_m = static_cast<float>(level_m * std::sin(azimuth));
  point.z_m = static_cast<float>(range_m * std::sin(beam.elevation_deg * kDeg));
  point.intensity = intensity;
  point.ring = beam.ring;
  point.time_offset_ns =
      static_cast<std::uint32_t>(std::llround(1e8 * column / columns + 1e3 * beam.firing_us));
  return point;
}

/// Lasers 0 and 1 of a VLP-16: the lowest ring, and the one at 1 deg, which fires 2.304 us later.
constexpr Beam kVlp16Low{15, -15, 0, 0}, kVlp16Up{7, 1, 0, 2.304};
constexpr int kVelodyneColumns = 1808;
constexpr TimeNs kTurn_ns = 100'000'000;
/// Laser 0 of a VLP-32C, the lowest ring, looks 1.4 deg to the right of the head.
constexpr Beam kVlp32cLow{31, -25, 1.4, 0};
/// The uppermost beam of the preset os1_32.
constexpr Beam kOs1Beam{0, 21.2, 4.23, 0};

class LidarPacketsTest : public testing::Test {
 protected:
  void Record(const std::string& sheet, const std::vector<LidarScan>& scans) {
    fs::remove_all(recording());
    DatasetWriter writer(recording(), SampleInfo(), {});
    const ChannelId lidar = writer.AddChannel({.path = "digger/roof",
                                               .type = std::string(kLidarChannel),
                                               .form = ChannelForm::kScans,
                                               .sensor_yaml = sheet,
                                               .columns = {}});
    for (const LidarScan& scan : scans) writer.Write(lidar, LidarScan(scan));
    writer.Finish();
  }
  void ToPcap(const ExportOptions& more = {}) {
    ExportOptions options = more;
    options.format = ExportFormat::kPcap;
    fs::remove_all(out());
    Export(recording(), out(), options);
  }
  void ExpectFault(FaultKind kind, const std::string& place) {
    fs::remove_all(out());
    EXPECT_THAT([&] { ToPcap(); }, ThrowsFault(kind, place));
    EXPECT_FALSE(fs::exists(out()));
    EXPECT_FALSE(fs::exists(out().string() + ".incomplete"));
  }
  std::string Pcap() const { return ReadWholeFile(out() / "digger/roof.pcap"); }
  /// The scans that an import of the packets gives, at the unit's own times.
  std::vector<LidarScan> Imported(const std::string& unit) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: back\nmachine: digger\nlidars: [{name: roof, file: out/digger/roof.pcap, "
                   "returns: all, time: {column: unit}, " +
                       unit + "}]\n");
    fs::remove_all(scratch_.path() / "back");
    ImportCsv(scratch_.path() / "mapping.yaml", scratch_.path() / "back");
    const Recording back(scratch_.path() / "back");
    std::vector<LidarScan> scans;
    for (const TimeNs t_ns : back.FrameTimes("digger/roof")) {
      scans.push_back(back.LoadScan("digger/roof", t_ns));
    }
    return scans;
  }
  fs::path recording() const { return scratch_.path() / "run"; }
  fs::path out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

/// The file header, a packet's header, and the headers of Ethernet, IP and UDP.
constexpr std::size_t kFileHead = 24, kHeads = 16 + 14 + 20 + 8;

std::string Part(const std::string& bytes, std::size_t at, std::size_t count) {
  return bytes.substr(at, count);
}

// --- By hand.

// VLP-16 User Manual 63-9243, section 9.3: ranges in 2 mm, azimuths in 0.01 deg, all low byte
// first. Its example of a stamp is 61 67 b9 5a, 1522.100065 s past the hour.
TEST_F(LidarPacketsTest, TheFirstPacketOfAVlp16IsTheManuals) {
  Record(SheetOf("vlp16"), {{0,
                             0,
                             {PointOf(kVlp16Low, 0, kVelodyneColumns, 10, 0.2F),
                              PointOf(kVlp16Up, 3, kVelodyneColumns, 5, 1)}}});
  ToPcap({.start_utc_ns = 471000 * 3600 * kNsPerSecond + 1'522'100'065'000});
  const std::string pcap = Pcap();
  // 1808 columns, 24 to a packet: 75 packets and a third of another.
  ASSERT_EQ(pcap.size(), kFileHead + 76 * (kHeads + 1206));
  const std::string packet = pcap.substr(kFileHead + kHeads, 1206);
  EXPECT_EQ(Part(packet, 0, 4), "\xff\xee\x50\x46");  // behind: 180.00 deg, 0x4650
  EXPECT_EQ(Part(packet, 4, 3), "\x88\x13\x33");      // 5000 steps, 51 of 255
  // Two columns later: 180 + 2 * 360 / 1808 = 180.398 deg, 0x4678.
  EXPECT_EQ(Part(packet, 100, 4), "\xff\xee\x78\x46");
  // The block's second sequence begins at its return 16, laser 1 is the next.
  EXPECT_EQ(Part(packet, 100 + 4 + 3 * 17, 3), "\xc4\x09\xff");  // 2500 steps
  EXPECT_EQ(Part(packet, 1200, 6), "\x61\x67\xb9\x5a\x37\x22");  // strongest return, VLP-16
  EXPECT_EQ(std::count(packet.begin(), packet.end(), '\0'), 1206 - 12 * 4 - 3 - 3 - 6);
}

TEST_F(LidarPacketsTest, TheHeadersAreThoseOfUdpInEthernet) {
  Record(SheetOf("vlp16"), {{0, 0, {}}});
  ToPcap({.start_utc_ns = kNsPerSecond});
  const std::string pcap = Pcap();
  EXPECT_EQ(Part(pcap, 0, 4), "\xd4\xc3\xb2\xa1");               // microseconds
  EXPECT_EQ(Part(pcap, 20, 4), std::string("\x01\0\0\0", 4));    // Ethernet
  EXPECT_EQ(Part(pcap, 24, 4), std::string("\x01\0\0\0", 4));    // 1 s, and
  EXPECT_EQ(Part(pcap, 28, 4), std::string("\x2f\x05\0\0", 4));  // 24 columns of 55.31 us later
  EXPECT_EQ(Part(pcap, 32, 4), std::string("\xe0\x04\0\0", 4));  // 1248 bytes
  const std::string ip = Part(pcap, kFileHead + 16 + 14, 20);
  EXPECT_EQ(Part(ip, 0, 4), std::string("\x45\0\x04\xd2", 4));  // 1234 bytes
  std::uint32_t sum = 0;  // of all words, with the checksum: all ones
  for (std::size_t k = 0; k < ip.size(); k += 2) {
    sum += static_cast<unsigned char>(ip[k]) * 256U + static_cast<unsigned char>(ip[k + 1]);
  }
  EXPECT_EQ((sum & 0xffff) + (sum >> 16), 0xffffU);
  EXPECT_EQ(Part(pcap, kFileHead + kHeads - 8, 8), std::string("\x09\x40\x09\x40\x04\xbe\0\0", 8));
}

// Firmware manual, RNG19_RFL8_SIG16_NIR16: header of 32 bytes, columns of 12 and 12 for each pixel:
// range in mm, reflectivity, signal, near infrared.
TEST_F(LidarPacketsTest, TheFirstPacketOfAnOusterIsTheManuals) {
  Record(SheetOf("os1_32", {{"beam", ""}}),
         {{0, 0, {}}, {kTurn_ns, kTurn_ns, {PointOf(kOs1Beam, 1, 1024, 10, 0.2F)}}});
  ToPcap({.start_utc_ns = 1'000'000'000'000});
  const std::string pcap = Pcap();
  // 64 + 16 * (12 + 32 * 12) = 6400 bytes: five fragments, 64 packets for each scan.
  constexpr std::size_t kPacket = 6400, kDatagram = 5 * (kHeads - 8) + 8 + kPacket;
  ASSERT_EQ(pcap.size(), kFileHead + 2 * 64 * kDatagram);
  const std::size_t at = kFileHead + 64 * kDatagram + kHeads;
  EXPECT_EQ(Part(pcap, at, 4), std::string("\x01\0\x01\0", 4));  // lidar packet, second frame
  // Column 1 leaves 1 / 10240 s into the scan at 1000.1 s.
  const std::size_t column = at + 32 + 12 + 32 * 12;
  EXPECT_EQ(Part(pcap, column, 12),
            Bytes(std::uint64_t{1'000'100'097'656}) + std::string("\x01\0\x01\0", 4));
  EXPECT_EQ(Part(pcap, column + 12, 12), std::string("\x10\x27\0\0\x33\0\0\0\0\0\0\0", 12));
}

// A VLP-32C counts ranges in 4 mm. In dual mode, pairs of blocks hold the last return, then the
// strongest or second strongest; a single return stands in both.
TEST_F(LidarPacketsTest, APairOfBlocksHoldsTwoReturns) {
  Record(SheetOf("vlp32c"), {{0,
                              0,
                              {PointOf(kVlp32cLow, 0, kVelodyneColumns, 8, 0.4F),
                               PointOf(kVlp32cLow, 0, kVelodyneColumns, 20, 0.2F),
                               PointOf(kVlp32cLow, 1, kVelodyneColumns, 12, 0.6F)}}});
  ToPcap({.start_utc_ns = 0});
  const std::string packet = Part(Pcap(), kFileHead + kHeads, 1206);
  EXPECT_EQ(Part(packet, 0, 7), "\xff\xee\x50\x46\x88\x13\x33");    // 5000 steps
  EXPECT_EQ(Part(packet, 100, 7), "\xff\xee\x50\x46\xd0\x07\x66");  // 2000 steps
  EXPECT_EQ(Part(packet, 200, 7), "\xff\xee\x64\x46\xb8\x0b\x99");  // 180.20 deg, 3000 steps
  EXPECT_EQ(Part(packet, 300, 7), Part(packet, 200, 7));
  EXPECT_EQ(Part(packet, 1204, 2), "\x39\x28");
  const auto scans = Imported("unit: vlp32c");
  std::vector<double> ranges_m;
  for (const LidarScan& scan : scans) {
    for (const LidarPoint& point : scan.points) {
      ranges_m.push_back(std::hypot(point.x_m, point.y_m, point.z_m));
    }
  }
  EXPECT_THAT(ranges_m, testing::Pointwise(testing::FloatNear(1e-5), {8.0, 20.0, 12.0}));
}

// --- Metadata.

TEST_F(LidarPacketsTest, AnOustersMetadataAreReadBack) {
  Record(SheetOf("os1_32"), {{0, 0, {}}});
  ToPcap();
  const OusterSheet sheet = ReadOusterSheet(out() / "digger/roof.json");
  EXPECT_EQ(sheet.product, "OS-1-32");
  EXPECT_EQ(sheet.serial, 1U);
  EXPECT_EQ(sheet.profile, "RNG19_RFL8_SIG16_NIR16_DUAL");
  EXPECT_EQ(sheet.columns_per_frame, 1024);
  EXPECT_EQ(sheet.rate_hz, 10);
  EXPECT_EQ(sheet.port, 7502);
  ASSERT_EQ(sheet.beams, 32);
  EXPECT_NEAR(sheet.altitude_rad[0], 21.2 * kDeg, 1e-12);
  EXPECT_NEAR(sheet.altitude_rad[31], -21.2 * kDeg, 1e-12);
  // An Ouster's azimuths turn clockwise, those of a scenario counter-clockwise.
  EXPECT_NEAR(sheet.azimuth_rad[0], 4.23 * kDeg, 1e-12);
  EXPECT_TRUE(sheet.X_SL.isApprox(MakePose(Vec3::Zero(), Mat3(Vec3(-1, -1, 1).asDiagonal()))));
  // A real OS-1-128 with four rows of beams at 4.2 to -4.2 deg states these shifts.
  const auto json = nlohmann::json::parse(ReadWholeFile(out() / "digger/roof.json"));
  const auto shifts = json["lidar_data_format"]["pixel_shift_by_row"].get<std::vector<int>>();
  EXPECT_EQ(std::vector<int>(shifts.begin(), shifts.begin() + 4), (std::vector{12, 4, -4, -12}));
}

// --- There and back.

struct Returned {
  double t_s = 0, range_m = 0, azimuth_deg = 0, intensity = 0;
};
using ByRing = std::map<std::uint16_t, std::vector<Returned>>;

/// Points of scans by ring and in order of time. `up_m` lies above the origin from which a ring's
/// range counts.
ByRing PointsOf(const std::vector<LidarScan>& scans, const std::vector<double>& up_m) {
  ByRing rings;
  for (const LidarScan& scan : scans) {
    for (const LidarPoint& point : scan.points) {
      const double z_m = point.z_m - (up_m.empty() ? 0 : up_m[point.ring]);
      rings[point.ring].push_back({ToSeconds(scan.t_ns + point.time_offset_ns),
                                   std::hypot(point.x_m, point.y_m, z_m),
                                   std::atan2(point.y_m, point.x_m) / kDeg, point.intensity});
    }
  }
  return rings;
}

struct RoundTrip {
  std::string preset, unit;
  double step_m, azimuth_deg, time_s;
  std::vector<double> up_m = {};  ///< of a ring, by the manual
};
void PrintTo(const RoundTrip& trip, std::ostream* out) { *out << trip.preset; }

class LidarRoundTrip : public LidarPacketsTest, public testing::WithParamInterface<RoundTrip> {};

TEST_P(LidarRoundTrip, ScansComeBackByTeraImport) {
  const RoundTrip& trip = GetParam();
  const std::string sheet = SheetOf(trip.preset, {{"beam", ""}});
  fs::create_directory(scratch_.path() / "sensor");
  WriteWholeFile(scratch_.path() / "sensor/sensor.yaml", sheet);
  const LidarPattern pattern = ReadLidarPattern(scratch_.path() / "sensor");
  std::vector<LidarScan> scans = {{0, 0, {}}, {kTurn_ns, kTurn_ns, {}}};
  for (int k = 0; k < 2; ++k) {
    for (int column = 0; column < pattern.columns; ++column) {
      for (std::size_t ring = 0; ring < pattern.rings(); ++ring) {
        if ((column + ring + k) % 5 == 0) continue;  // no return
        const Beam beam{static_cast<std::uint16_t>(ring), pattern.elevation_deg[ring],
                        -pattern.azimuth_offset_deg[ring], pattern.firing_us[ring]};
        const double range_m = 2 + 0.01013 * static_cast<double>((37 * column + 101 * ring) % 9000);
        scans[k].points.push_back(PointOf(beam, column, pattern.columns, range_m,
                                          static_cast<float>((column + 7 * ring) % 256) / 255.4F));
      }
    }
  }
  Record(sheet, scans);
  ToPcap({.start_utc_ns = 0});
  ByRing before = PointsOf(scans, {}), after = PointsOf(Imported(trip.unit), trip.up_m);
  ASSERT_EQ(after.size(), pattern.rings());
  Returned most;
  for (auto& [ring, points] : before) {
    ASSERT_EQ(after[ring].size(), points.size()) << ring;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Returned &a = points[k], &b = after[ring][k];
      most.t_s = std::max(most.t_s, std::abs(a.t_s - b.t_s));
      most.range_m = std::max(most.range_m, std::abs(a.range_m - b.range_m));
      most.azimuth_deg =
          std::max(most.azimuth_deg, std::abs(std::remainder(a.azimuth_deg - b.azimuth_deg, 360)));
      most.intensity = std::max(most.intensity, std::abs(a.intensity - b.intensity));
    }
  }
  RecordProperty("range_m", fmt::format("{:.6f}", most.range_m));
  RecordProperty("azimuth_deg", fmt::format("{:.5f}", most.azimuth_deg));
  RecordProperty("time_us", fmt::format("{:.3f}", 1e6 * most.t_s));
  EXPECT_LE(most.range_m, trip.step_m / 2 + 2e-5);  // and floats of some 100 m
  EXPECT_LE(most.azimuth_deg, trip.azimuth_deg);
  EXPECT_LE(most.t_s, trip.time_s);
  EXPECT_LE(most.intensity, 0.5 / 255 + 1e-6);
}

// A Velodyne's azimuths are rounded to 0.01 deg, and interpolated to each firing. The decoder has
// no block behind the last of a packet: it extrapolates by the turn of the block before, whose two
// azimuths are each off by up to 0.005 deg.
constexpr double kVelodyneAzimuth_deg = 0.005 + 0.01;
const std::vector<double> kUp_m = {-0.0112, -0.0097, -0.0081, -0.0066, -0.0051, -0.0037,
                                   -0.0022, -0.0007, 0.0007,  0.0022,  0.0037,  0.0051,
                                   0.0066,  0.0081,  0.0097,  0.0112};
INSTANTIATE_TEST_SUITE_P(
    Presets, LidarRoundTrip,
    testing::Values(RoundTrip{"vlp16", "unit: vlp16", 0.002, kVelodyneAzimuth_deg, 1e-6, kUp_m},
                    RoundTrip{"vlp32c", "unit: vlp32c", 0.004, kVelodyneAzimuth_deg, 1e-6},
                    RoundTrip{"os0_128", "metadata: out/digger/roof.json", 0.001, 1e-3, 2e-9},
                    RoundTrip{"os1_32", "metadata: out/digger/roof.json", 0.001, 1e-3, 2e-9},
                    RoundTrip{"os1_64", "metadata: out/digger/roof.json", 0.001, 1e-3, 2e-9},
                    RoundTrip{"os1_128", "metadata: out/digger/roof.json", 0.001, 1e-3, 2e-9},
                    RoundTrip{"os2_128", "metadata: out/digger/roof.json", 0.001, 1e-3, 2e-9}),
    [](const auto& tested) { return tested.param.preset; });

TEST_F(LidarPacketsTest, TwoReturnsOfAnOusterComeBack) {
  Record(
      SheetOf("os1_32"),
      {{0,
        0,
        {PointOf(kOs1Beam, 700, 1024, 9.0621, 0.2F), PointOf(kOs1Beam, 700, 1024, 4.5003, 0.1F)}}});
  ToPcap({.start_utc_ns = 0});
  const auto scans = Imported("metadata: out/digger/roof.json");
  ASSERT_EQ(scans.size(), 1u);
  ASSERT_EQ(scans[0].points.size(), 2u);
  EXPECT_NEAR(std::hypot(scans[0].points[0].x_m, scans[0].points[0].y_m, scans[0].points[0].z_m),
              9.062, 1e-5);
  EXPECT_NEAR(std::hypot(scans[0].points[1].x_m, scans[0].points[1].y_m, scans[0].points[1].z_m),
              4.5, 1e-5);
}

TEST_F(LidarPacketsTest, AScanWithoutReturnsIsPacketsWithoutReturns) {
  Record(SheetOf("vlp16"), {{0, 0, {}}, {kTurn_ns, kTurn_ns, {}}});
  ToPcap({.start_utc_ns = 0});
  // 3616 columns are 150 packets and two thirds of another.
  EXPECT_EQ(Pcap().size(), kFileHead + 151 * (kHeads + 1206));
  for (const LidarScan& scan : Imported("unit: vlp16")) EXPECT_TRUE(scan.points.empty());
  Record(SheetOf("os1_32"), {{0, 0, {}}});
  ToPcap({.start_utc_ns = 0});
  const auto scans = Imported("metadata: out/digger/roof.json");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_TRUE(scans[0].points.empty());
}

TEST_F(LidarPacketsTest, TimeWithoutScansHasNoPackets) {
  Record(
      SheetOf("vlp16"),
      {{0, 0, {}}, {4 * kTurn_ns, 4 * kTurn_ns, {PointOf(kVlp16Low, 5, kVelodyneColumns, 9, 1)}}});
  ToPcap({.start_utc_ns = 0});
  EXPECT_EQ(Pcap().size(), kFileHead + 152 * (kHeads + 1206));
  const ByRing points = PointsOf(Imported("unit: vlp16"), kUp_m);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points.at(15)[0].t_s, 0.4 + 5 * 0.1 / kVelodyneColumns, 1e-6);
}

TEST_F(LidarPacketsTest, AreTheSameBytesTwice) {
  Record(SheetOf("vlp16"), {{0, 0, {PointOf(kVlp16Low, 0, kVelodyneColumns, 10, 0.2F)}},
                            {kTurn_ns, kTurn_ns, {}},
                            {2 * kTurn_ns, 2 * kTurn_ns, {}}});
  ToPcap({.threads = 1});
  const auto first = AllFiles(out());
  ToPcap({.threads = 7});
  EXPECT_EQ(AllFiles(out()), first);
}

// --- Refusals.

TEST_F(LidarPacketsTest, ARangeBeyondTheFormatsLargestIsRefused) {
  Record(SheetOf("vlp16"), {{0, 0, {PointOf(kVlp16Low, 0, kVelodyneColumns, 131.07, 0.2F)}}});
  ToPcap();
  EXPECT_EQ(Part(Pcap(), kFileHead + kHeads + 4, 2), "\xff\xff");
  Record(SheetOf("vlp16"), {{0, 0, {PointOf(kVlp16Low, 0, kVelodyneColumns, 131.08, 0.2F)}}});
  ExpectFault(kInconsistent, "scans/0.pcd: point 1");
  Record(SheetOf("os2_128"), {{0, 0, {PointOf({0, 11.25, 4.23, 0}, 0, 1024, 524.3, 0.2F)}}});
  ExpectFault(kInconsistent, "scans/0.pcd: point 1");
}

TEST_F(LidarPacketsTest, APatternOfNoUnitIsRefused) {
  using Changes = std::map<std::string, std::string>;
  const auto refused = [&](const std::string& preset, const Changes& changes) {
    Record(SheetOf(preset, changes), {{0, 0, {}}});
    ExpectFault(kUnsupported, "digger/roof/sensor.yaml: model");
  };
  refused("vlp16", {{"columns", "900"}});
  refused("vlp16", {{"rate_hz", "20"}});
  refused("vlp16", {{"clockwise", "false"}});
  refused("vlp16", {{"firing_offset_us", ""}});
  refused("vlp16", {{"beam", "{divergence_mrad: 3, returns: 3}"}});
  refused("vlp16", {{"beam", "{divergence_mrad: 3, pick: first}"}});
  refused("vlp32c", {{"azimuth_offset_deg", ""}});
  refused("os1_64", {{"columns", "1000"}});
  refused("os1_64", {{"rate_hz", "15"}});
  for (const char* preset : {"hdl64e", "xt32", "qt64", "pandar40p"}) {
    refused(preset, {});
  }
  Record("type: lidar\nname: roof\n", {{0, 0, {}}});
  ExpectFault(kUnsupported, "digger/roof/sensor.yaml: model");
}

TEST_F(LidarPacketsTest, PointsThatAreNotOnPulsesAreRefused) {
  LidarPoint moved = PointOf(kVlp16Low, 0, kVelodyneColumns, 10, 0.2F);
  moved.y_m += 0.01F;
  Record(SheetOf("vlp16"), {{0, 0, {moved}}});
  ExpectFault(kInconsistent, "scans/0.pcd: point 1");
  const LidarPoint point = PointOf(kVlp16Low, 0, kVelodyneColumns, 10, 0.2F);
  Record(SheetOf("vlp16"), {{0, 0, {point, point}}});  // a second return of a single one
  ExpectFault(kInconsistent, "scans/0.pcd: point 2");
  LidarPoint seventeenth = point;
  seventeenth.ring = 16;
  Record(SheetOf("vlp16"), {{0, 0, {seventeenth}}});
  ExpectFault(kInconsistent, "scans/0.pcd: point 1");
}

TEST_F(LidarPacketsTest, PointsThatAreNotFiniteAreRefused) {
  const LidarPoint point = PointOf(kVlp16Low, 0, kVelodyneColumns, 10, 0.2F);
  for (float LidarPoint::*const member :
       {&LidarPoint::x_m, &LidarPoint::y_m, &LidarPoint::z_m, &LidarPoint::intensity}) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      LidarPoint second = PointOf(kVlp16Low, 1, kVelodyneColumns, 10, 0.2F);
      second.*member = bad;
      Record(SheetOf("vlp16"), {{0, 0, {point, second}}});
      ExpectFault(kInconsistent, "scans/0.pcd: point 2");
    }
  }
}

TEST_F(LidarPacketsTest, ScansThatOverlapAreRefused) {
  Record(SheetOf("vlp16"), {{0, 0, {}}, {kTurn_ns / 2, kTurn_ns / 2, {}}});
  ExpectFault(kInconsistent, "scans/50000000.pcd");
}

TEST_F(LidarPacketsTest, OneLidarOfSeveralIsChosen) {
  DatasetWriter writer(recording(), SampleInfo(), {});
  writer.Write(writer.AddChannel(LidarChannel("digger/left", SheetOf("xt32"))), LidarScan{});
  writer.Write(writer.AddChannel(LidarChannel("digger/roof", SheetOf("vlp16"))), LidarScan{});
  writer.Finish();
  ExpectFault(kUnsupported, "digger/left/sensor.yaml: model");
  ToPcap({.lidar = "digger/roof"});
  EXPECT_EQ(AllFiles(out()).size(), 1u);
  fs::remove_all(out());
  EXPECT_THAT([&] { ToPcap({.lidar = "digger/front"}); }, ThrowsFault(kNoSuchName, "--lidar"));
}

}  // namespace
}  // namespace tera
