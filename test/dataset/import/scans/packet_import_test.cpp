#include <cmath>
#include <numbers>

#include "dataset/import/bag_bytes.h"
#include "dataset/import/scans/lidar_import.h"
#include "dataset/import/suggest/suggest.h"

// Packets by hand, with points by the manuals' formulas.

namespace tera {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr char kVlp16[] = "file: log.pcap, unit: vlp16";

// --- Velodyne.

TEST_F(LidarImportTest, AVelodynesReturnsLieWhereItsManualSays) {
  // Laser 0 looks down by 15 degrees, laser 1 up by 1; at azimuth 90 they look to the right. At the
  // second firing of a block, 55.296 us later, half of the block's turn of 0.4 degrees has passed,
  // and a further 2.304 / 110.592 of it at laser 1.
  File("log.pcap", PcapByHand()
                       .Packet(1000, Vlp16Packet(7000, 90, 0.4)
                                         .Return(0, 0, 5000, 51)    // 10 m
                                         .Return(0, 17, 2500, 255)  // 5 m
                                         .bytes())
                       .bytes());
  Import(kVlp16);
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].t_ns, 1000 * kNsPerSecond);
  ASSERT_EQ(scans[0].points.size(), 2u);
  // The manual's vertical correction of laser 0 is 11.2 mm, of laser 1 -0.7 mm.
  ExpectPlace(scans[0].points[0],
              {0, -10 * std::cos(15 * kDeg), -10 * std::sin(15 * kDeg) + 0.0112});
  const double a = (90 + 0.2 + 0.4 * 2.304 / 110.592) * kDeg;
  ExpectPlace(scans[0].points[1],
              {5 * std::cos(1 * kDeg) * std::cos(a), -5 * std::cos(1 * kDeg) * std::sin(a),
               5 * std::sin(1 * kDeg) - 0.0007});
  EXPECT_EQ(scans[0].points[0].ring, 15);  // the lowest of 16
  EXPECT_EQ(scans[0].points[1].ring, 7);   // 15, 13, ..., 3 degrees lie above 1
  EXPECT_FLOAT_EQ(scans[0].points[0].intensity, 0.2F);
  EXPECT_EQ(scans[0].points[0].time_offset_ns, 0u);
  EXPECT_EQ(scans[0].points[1].time_offset_ns, 57600u);
}

TEST_F(LidarImportTest, AScanEndsWhereTheTurnDoes) {
  PcapByHand pcap;
  // 0.4 degrees in 110.592 us: a turn of 900 blocks, 75 packets, 99.5 ms.
  for (int k = 0; k < 160; ++k) {
    const double degrees = std::fmod(4.8 * k, 360.0);
    pcap.Packet(2000 + 1327.104e-6 * k,
                Vlp16Packet(static_cast<std::uint32_t>(1327.104 * k), degrees, 0.4)
                    .Return(3, 4, 1000, 9)
                    .bytes());
  }
  File("log.pcap", pcap.bytes());
  const ImportReport report =
      Import("file: log.pcap, unit: vlp16, mount: {link: cab, xyz_m: [0, 0, 3]}", "zero: start\n");
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans[0].points.size(), 75u);
  EXPECT_EQ(scans[1].points.size(), 75u);
  EXPECT_EQ(scans[2].points.size(), 10u);
  EXPECT_EQ(scans[0].t_ns, 0);
  EXPECT_NEAR(ToSeconds(scans[1].t_ns), 0.0995328, 2e-6);
  // By the unit's own clock, whole microseconds, within a scan.
  EXPECT_NEAR(scans[1].points[74].time_offset_ns - scans[1].points[0].time_offset_ns,
              74 * 1327104.0, 1500);
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("1 of 3 scans")));
  const std::string sheet = ReadWholeFile(Out() / "digger/roof/sensor.yaml");
  EXPECT_THAT(sheet, HasSubstr("parent_link: cab"));
  EXPECT_THAT(sheet, HasSubstr("rate_hz: 10.0"));
  EXPECT_THAT(sheet, HasSubstr("elevation_deg: [15, 13, 11,"));
}

TEST_F(LidarImportTest, OfTwoReturnsTheStrongerOneIsKeptUnlessBothAreAskedFor) {
  // Blocks in pairs: the last return, then the strongest. Laser 2 has the same twice.
  File("log.pcap", PcapByHand()
                       .Packet(5, Vlp16Packet(0, 10, 0.2, 0x39)
                                      .Return(0, 0, 4000, 20)
                                      .Return(1, 0, 3000, 80)
                                      .Return(0, 2, 1500, 30)
                                      .Return(1, 2, 1500, 30)
                                      .bytes())
                       .bytes());
  const ImportReport report = Import(kVlp16);
  ASSERT_EQ(Scans()[0].points.size(), 2u);
  EXPECT_NEAR(PlaceOf(Scans()[0].points[0]).norm(), 6, 0.004);
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("1 second returns left out")));
  Import(std::string(kVlp16) + ", returns: all");
  const auto points = Scans()[0].points;
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR(PlaceOf(points[0]).norm(), 6, 0.004);
  EXPECT_NEAR(PlaceOf(points[1]).norm(), 8, 0.004);
  EXPECT_EQ(points[0].ring, points[1].ring);
  EXPECT_EQ(points[0].time_offset_ns, points[1].time_offset_ns);
}

TEST_F(LidarImportTest, TheUnitsClockIsCompletedByTheReceiversHour) {
  // Received 0.1 s into an hour, 0.2 s after the packet's first firing in the previous hour.
  const double hour_s = 471000.0 * 3600;
  File("log.pcap",
       PcapByHand()
           .Packet(hour_s + 0.1, Vlp16Packet(3599'900'000, 10, 0.2).Return(0, 0, 1000, 1).bytes())
           .bytes());
  Import("file: log.pcap, unit: vlp16, time: {column: unit, offset: 1.5}", "zero: start\n");
  const Recording recording(Out());
  ASSERT_TRUE(recording.info().epoch);
  EXPECT_EQ(recording.info().epoch->since_1970_ns, 471000 * 3600 * kNsPerSecond + 1'400'000'000);
}

TEST_F(LidarImportTest, FragmentsOfADatagramAreJoined) {
  const std::string udp = Udp(Vlp16Packet(0, 10, 0.2).Return(0, 1, 1000, 1).bytes(), 2368);
  File("log.pcap", PcapByHand()
                       .Frame(1, Ipv4(udp.substr(800), 100))  // from byte 8 * 100, the last
                       .Frame(1.0001, Ipv4(udp.substr(0, 800), 0x2000))  // more to come
                       .bytes());
  Import(kVlp16);
  EXPECT_EQ(Scans()[0].points.size(), 1u);
}

TEST_F(LidarImportTest, PacketsThatAreNoneOfTheUnitAreTold) {
  const std::string good = Vlp16Packet(0, 10, 0.2).Return(0, 1, 1000, 1).bytes();
  const std::string later = Vlp16Packet(2000, 14, 0.2).Return(0, 1, 1000, 1).bytes();
  File("log.pcap", PcapByHand().Packet(1, good.substr(0, 700)).bytes());
  ExpectFault(kVlp16, FaultKind::kMalformed, "log.pcap: packet 1");
  File("log.pcap", PcapByHand().Packet(1, Vlp16Packet(0, 1, 0.2, 0x37, 0x28).bytes()).bytes());
  ExpectFault(kVlp16, FaultKind::kInconsistent, "log.pcap: packet 1");
  std::string unflagged = good;
  unflagged[300] = 0;
  File("log.pcap", PcapByHand().Packet(1, good).Packet(1.1, unflagged).bytes());
  ExpectFault(kVlp16, FaultKind::kMalformed, "log.pcap: packet 2");
  File("log.pcap", PcapByHand().Packet(1, later).Packet(1.1, good).bytes());
  ExpectFault(kVlp16, FaultKind::kInconsistent, "log.pcap: packet 2");
  // One of three is skipped on request.
  File("log.pcap",
       PcapByHand().Packet(1, good).Packet(1.0005, unflagged).Packet(1.002, later).bytes());
  const ImportReport report = Import(kVlp16, "", {.skips_bad_rows = true});
  EXPECT_EQ(report.channels[0].left_out, 1);
  EXPECT_EQ(Scans()[0].points.size(), 2u);
}

TEST_F(LidarImportTest, CapturesOfOtherTrafficAndCutOnesAreTold) {
  const std::string good = Vlp16Packet(0, 10, 0.2).Return(0, 1, 1000, 1).bytes();
  File("log.pcap", PcapByHand().Packet(1, "query", 53).Frame(2, Ipv4("x", 0, 6)).bytes());
  ExpectFault(kVlp16, FaultKind::kMissing, "log.pcap");
  ExpectFault("file: log.pcap, unit: vlp16, port: 53", FaultKind::kMalformed, "log.pcap: packet 1");
  File("log.pcap", "columns of a table, but no capture");
  ExpectFault(kVlp16, FaultKind::kMalformed, "log.pcap");
  const std::string whole = PcapByHand().Packet(1, good).Packet(1.1, good).bytes();
  File("log.pcap", whole.substr(0, whole.size() - 300));
  ExpectFault(kVlp16, FaultKind::kMalformed, "log.pcap: packet 1");
  ExpectFault("file: none.pcap, unit: vlp16", FaultKind::kUnreadable, "file");
  ExpectFault("file: log.pcap", FaultKind::kMissing, "unit");
  ExpectFault("file: log.pcap, unit: ouster", FaultKind::kMissing, "metadata");
}

TEST_F(LidarImportTest, TheUnitOfACaptureIsSuggested) {
  const std::string good = Vlp16Packet(0, 10, 0.2).Return(0, 1, 1000, 1).bytes();
  File("log.pcap", PcapByHand().Packet(1, "query", 53).Packet(1.1, good).bytes());
  const std::string mapping = SuggestMapping(scratch_.path() / "log.pcap");
  EXPECT_THAT(mapping, HasSubstr("unit: vlp16"));
  EXPECT_THAT(mapping, HasSubstr("UDP to port 53"));
  File("mapping.yaml", mapping);
  EXPECT_EQ(ImportCsv(scratch_.path() / "mapping.yaml", Out()).channels[0].rows, 1);
  File("log.pcap", PcapByHand().Packet(1, "query", 53).bytes());
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "log.pcap"); },
              ThrowsFault(FaultKind::kMissing, "log.pcap"));
}

TEST_F(LidarImportTest, AVelodyneInABagIsTheSame) {
  const std::string packet = Vlp16Packet(0, 90, 0.4).Return(0, 0, 5000, 51).bytes();
  Cdr message;
  message.Header(1000, 0).Add(std::uint32_t{1}).Add(std::int32_t{1000}).Add(std::uint32_t{500});
  for (const char byte : packet) message.Add(byte);
  File("log.mcap",
       TopicsMcap().Message("/packets", "velodyne_msgs/msg/VelodyneScan", 7, message).bytes());
  Import("file: log.mcap, topic: /packets, unit: vlp16");
  ASSERT_EQ(Scans().size(), 1u);
  EXPECT_EQ(Scans()[0].t_ns, 1000 * kNsPerSecond + 500);
  EXPECT_NEAR(Scans()[0].points[0].y_m, -10 * std::cos(15 * kDeg), 1e-5);
  ExpectFault("file: log.mcap, topic: /packets", FaultKind::kMissing, "unit");
  ExpectFault("file: log.mcap, topic: /other, unit: vlp16", FaultKind::kNoSuchName, "topic");
  ExpectFault("file: log.mcap, unit: vlp16", FaultKind::kMissing, "topic");
}

// --- Hesai.

TEST_F(LidarImportTest, AQt64sReturnsLieWhereItsManualSays) {
  // Laser 33 of the design: elevation 0.725, azimuth 5.493 degrees.
  File("log.pcap", PcapByHand().Packet(9, Qt64Packet(30, 250, 32, 2500, 102)).bytes());
  Import("file: log.pcap, unit: qt64");
  const LidarScan scan = Scans()[0];
  ASSERT_EQ(scan.points.size(), 1u);
  const double w = 0.725 * kDeg, a = 35.493 * kDeg;
  ExpectPlace(scan.points[0],
              {10 * std::cos(w) * std::cos(a), -10 * std::cos(w) * std::sin(a), 10 * std::sin(w)});
  EXPECT_EQ(scan.points[0].ring, 31);
  EXPECT_FLOAT_EQ(scan.points[0].intensity, 0.4F);
  // Laser 33 fires 80.90 us after the block began, laser 1 12.31 us after.
  EXPECT_EQ(scan.points[0].time_offset_ns, 68590u);
  // The unit's own angles in place of the design's.
  std::string angles = "Laser id,Elevation,Azimuth\n";
  for (int n = 1; n <= 64; ++n)
    angles += std::to_string(n) + "," + std::to_string(n - 40) + ",-3\n";
  File("own.csv", angles);
  Import("file: log.pcap, unit: qt64, corrections: own.csv");
  ExpectPlace(Scans()[0].points[0],
              {10 * std::cos(-7 * kDeg) * std::cos(27 * kDeg),
               -10 * std::cos(-7 * kDeg) * std::sin(27 * kDeg), 10 * std::sin(-7 * kDeg)});
  File("own.csv", angles.substr(0, angles.size() / 2));
  ExpectFault("file: log.pcap, unit: qt64, corrections: own.csv", FaultKind::kMissing,
              "corrections");
}

TEST_F(LidarImportTest, AQt64sOwnClockIsUtc) {
  File("log.pcap", PcapByHand().Packet(9, Qt64Packet(30, 250, 32, 2500, 102)).bytes());
  Import("file: log.pcap, unit: qt64, time: {column: unit}", "zero: start\n");
  // 2023-01-11 10:20:30 UTC, and 25.71 + 12.31 us later than the packet's 250 us.
  EXPECT_EQ(Recording(Out()).info().epoch->since_1970_ns,
            1673432430 * kNsPerSecond + 250'000 + 38'020);
  std::string other = Qt64Packet(30, 250, 32, 2500, 102);
  other[6] = 40;
  File("log.pcap", PcapByHand().Packet(9, other).bytes());
  ExpectFault("file: log.pcap, unit: qt64", FaultKind::kInconsistent, "log.pcap: packet 1");
}

// --- Ouster.

/// range, reflectivity of RNG15_RFL8_NIR8.
std::string LowPixel(std::uint16_t steps, std::uint8_t reflectivity) {
  return Bytes(steps) + Bytes(reflectivity) + std::string(1, '\7');
}

/// Point of beam `i` of OusterMetadata at range r and column m, in the sensor's frame: the manual's
/// "Lidar range to XYZ", with its 180 degrees about z and 40 mm up.
Vec3 OusterPlace(double r_m, int beam, int column) {
  const double theta = 2 * std::numbers::pi * (1 - column / 8.0), n_m = 0.020;
  const double az = (beam == 0 ? 3 : -3) * kDeg, phi = (beam == 0 ? 30 : -10) * kDeg;
  return {-((r_m - n_m) * std::cos(theta - az) * std::cos(phi) + n_m * std::cos(theta)),
          -((r_m - n_m) * std::sin(theta - az) * std::cos(phi) + n_m * std::sin(theta)),
          (r_m - n_m) * std::sin(phi) + 0.040};
}

constexpr char kOuster[] = "file: os.pcap, metadata: os.json";

TEST_F(LidarImportTest, AnOustersLowBandwidthReturnsLieWhereItsManualSays) {
  File("os.json", OusterMetadata("RNG15_RFL8_NIR8"));
  const std::string none = LowPixel(0, 0);
  File("os.pcap",
       PcapByHand()
           .Packet(50,
                   OusterPacket(7, {{0, 1000, LowPixel(1250, 51) + none},
                                    {1, 13'000'000, none + LowPixel(0x8000 | 500, 255)}}),
                   7502)
           .Packet(50.05,
                   OusterPacket(7, {{4, 50'000'000, none + none},
                                    {5, 63'000'000, LowPixel(99, 1) + none, /*is_valid=*/false}}),
                   7502)
           .Packet(50.1,
                   OusterPacket(8, {{0, 100'000'000, LowPixel(250, 0) + none},
                                    {1, 113'000'000, none + none}}),
                   7502)
           .bytes());
  const ImportReport report = Import(kOuster);
  const auto scans = Scans();
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[0].t_ns, 1000);  // the columns' own stamps
  EXPECT_EQ(scans[1].t_ns, 100'000'000);
  ASSERT_EQ(scans[0].points.size(), 2u);
  ExpectPlace(scans[0].points[0], OusterPlace(10, 0, 0));
  ExpectPlace(scans[0].points[1], OusterPlace(4, 1, 1));
  EXPECT_EQ(scans[0].points[1].time_offset_ns, 12'999'000u);
  EXPECT_EQ(scans[0].points[1].ring, 1);
  EXPECT_FLOAT_EQ(scans[0].points[0].intensity, 0.2F);
  EXPECT_EQ(scans[1].points.size(), 1u);
  // Six rays of three valid columns, and four of the second frame; three came back.
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("70.0 % of the rays")));
  // By when packets were received instead.
  Import(std::string(kOuster) + ", time: {column: received}", "zero: start\n");
  EXPECT_NEAR(ToSeconds(Scans()[1].t_ns), 0.1, 1e-5);
}

TEST_F(LidarImportTest, EveryProfileOfAnOusterHasItsOwnPixels) {
  const Vec3 at = OusterPlace(10, 0, 2);
  const std::string rest = std::string(2, '\0');
  const auto import = [&](const std::string& profile, const std::string& pixel, bool is_legacy) {
    File("os.json", OusterMetadata(profile));
    const std::vector<OusterColumn> columns = {{2, 500, pixel + std::string(pixel.size(), '\0')},
                                               {3, 600, std::string(2 * pixel.size(), '\0')}};
    File("os.pcap",
         PcapByHand()
             .Packet(1, is_legacy ? LegacyOusterPacket(3, columns) : OusterPacket(3, columns), 7502)
             .bytes());
    Import(std::string(kOuster) + ", returns: all");
    return Scans()[0].points;
  };
  // 20 bits of range; reflectivity, signal and near-infrared of 16 bits each.
  auto points =
      import("LEGACY", Bytes(0xf0000000U | 10000U) + Bytes(102U) + std::string(4, '\3'), true);
  ASSERT_EQ(points.size(), 1u);
  ExpectPlace(points[0], at);
  EXPECT_FLOAT_EQ(points[0].intensity, 0.4F);
  // 19 bits of range.
  points = import("RNG19_RFL8_SIG16_NIR16",
                  Bytes(0xfff80000U | 10000U) + Bytes(102U) + std::string(4, '\3'), false);
  ASSERT_EQ(points.size(), 1u);
  ExpectPlace(points[0], at);
  // 19 bits and 8 of reflectivity, twice.
  points =
      import("RNG19_RFL8_SIG16_NIR16_DUAL",
             Bytes(102U << 24 | 10000U) + Bytes(51U << 24 | 12000U) + std::string(8, '\3'), false);
  ASSERT_EQ(points.size(), 2u);
  ExpectPlace(points[0], at);
  ExpectPlace(points[1], OusterPlace(12, 0, 2));
  EXPECT_FLOAT_EQ(points[1].intensity, 0.2F);
  points = import("RNG15_RFL8_NIR8_DUAL", LowPixel(1250, 102) + LowPixel(1500, 51), false);
  ASSERT_EQ(points.size(), 2u);
  ExpectPlace(points[0], at);
  ExpectPlace(points[1], OusterPlace(12, 0, 2));
}

TEST_F(LidarImportTest, PacketsAndMetadataOfAnOusterMustFit) {
  const std::string column = LowPixel(100, 1) + LowPixel(100, 1);
  const auto packet = [&](std::uint16_t frame, std::uint16_t number) {
    return OusterPacket(frame, {{number, 5, column}, {1, 6, column}});
  };
  File("os.json", OusterMetadata("RNG15_RFL8_NIR8"));
  File("os.pcap", PcapByHand().Packet(1, packet(1, 0) + "x", 7502).bytes());
  ExpectFault(kOuster, FaultKind::kInconsistent, "os.pcap: packet 1");
  File("os.pcap", PcapByHand().Packet(1, packet(1, 9), 7502).bytes());
  ExpectFault(kOuster, FaultKind::kInconsistent, "os.pcap: packet 1");
  File("os.pcap",
       PcapByHand().Packet(1, packet(2, 0), 7502).Packet(1.1, packet(1, 0), 7502).bytes());
  ExpectFault(kOuster, FaultKind::kInconsistent, "os.pcap: packet 2");
  // Another unit of the same size.
  std::string metadata = OusterMetadata("RNG15_RFL8_NIR8"), of_another = packet(1, 0);
  File("os.json", metadata.insert(1, R"("prod_sn": "992137000142", )"));
  File("os.pcap", PcapByHand().Packet(1, of_another, 7502).bytes());
  Import(kOuster);  // it does not say
  PutAt(&of_another, 7, std::uint32_t{1000});
  File("os.pcap", PcapByHand().Packet(1, of_another, 7502).bytes());
  ExpectFault(kOuster, FaultKind::kInconsistent, "os.pcap: packet 1");
  // Two frames of the same stamps.
  File("os.pcap",
       PcapByHand().Packet(1, packet(2, 0), 7502).Packet(1.1, packet(3, 0), 7502).bytes());
  ExpectFault(kOuster, FaultKind::kInconsistent, "os.pcap: packet 2");
  File("os.json", OusterMetadata("RNG32_OF_THE_FUTURE"));
  ExpectFault(kOuster, FaultKind::kUnsupported, "metadata");
  File("os.json", OusterMetadata("RNG15_RFL8_NIR8", "16x10"));
  ExpectFault(kOuster, FaultKind::kInconsistent, "metadata");
  File("os.json", OusterMetadata("RNG15_RFL8_NIR8", "fast"));
  ExpectFault(kOuster, FaultKind::kMistyped, "metadata");
  File("os.json", "[1, 2");
  ExpectFault(kOuster, FaultKind::kMalformed, "metadata");
}

}  // namespace
}  // namespace tera
