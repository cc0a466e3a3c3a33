#include "dataset/import/logs/ulog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/import/import_csv.h"
#include "dataset/import/suggest/suggest.h"

/// Logs of PX4, composed byte by byte by "ULog File Format" of its user guide.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

template <typename T>
std::string Bytes(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

class Ulog {
 public:
  explicit Ulog(char version = 1)
      : bytes_(std::string("\x55\x4c\x6f\x67\x01\x12\x35", 7) + version +
               Bytes(std::uint64_t{1'000'000})) {}

  Ulog& Message(char type, const std::string& body) {
    bytes_ += Bytes(static_cast<std::uint16_t>(body.size())) + type + body;
    return *this;
  }
  Ulog& Flags(unsigned char compatible, unsigned char needed, std::uint64_t appended) {
    std::string body(40, '\0');
    body[0] = static_cast<char>(compatible);
    body[8] = static_cast<char>(needed);
    std::memcpy(body.data() + 16, &appended, sizeof appended);
    return Message('B', body);
  }
  Ulog& Format(const std::string& text) { return Message('F', text); }
  Ulog& Offer(std::uint16_t id, const std::string& name, char instance = 0) {
    return Message('A', instance + Bytes(id) + name);
  }
  Ulog& Data(std::uint16_t id, const std::string& payload) {
    return Message('D', Bytes(id) + payload);
  }
  Ulog& Raw(const std::string& bytes) {
    bytes_ += bytes;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

constexpr char kImu[] =
    "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;uint8_t[4] "
    "_padding0;";

std::string ImuRow(std::uint64_t t_us, float wz) {
  return Bytes(t_us) + Bytes(0.25f) + Bytes(-0.5f) + Bytes(wz) + Bytes(0.5f) + Bytes(1.5f) +
         Bytes(-9.75f);
}

/// An IMU in two instances, and a nested topic.
Ulog Whole() {
  Ulog log;
  log.Flags(0, 0, 0).Message('I',
                             "\x07"
                             "char[3] sys_nameTXT");
  log.Format(kImu)
      .Format("part:int16_t rpm;bool on;")
      .Format("escs:uint64_t timestamp;part[2] esc;double level;char[4] name;");
  log.Offer(3, "sensor_combined").Offer(4, "sensor_combined", 1).Offer(9, "escs");
  log.Data(3, ImuRow(2'000'000, 1)).Data(4, ImuRow(2'000'500, 7));
  log.Message('L', "6" + Bytes(std::uint64_t{5}) + "a text").Message('O', Bytes(std::uint16_t{20}));
  log.Data(9, Bytes(std::uint64_t{2'100'000}) + Bytes(std::int16_t{-300}) + '\1' +
                  Bytes(std::int16_t{400}) + std::string(1, '\0') + Bytes(2.5) + "abcd");
  return log.Data(3, ImuRow(2'010'000, 2));
}

class UlogTest : public ::testing::Test {
 protected:
  void Log(const std::string& bytes) { WriteWholeFile(scratch_.path() / "log.ulg", bytes); }
  ImportReport Import(const std::string& keys, const ImportOptions& options = {}) {
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   "name: logged\nmachine: rover\nfile: log.ulg\n" + keys);
    fs::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
  std::string FaultOf(const std::string& keys, const ImportOptions& options = {}) {
    try {
      Import(keys, options);
    } catch (const InputError& fault) {
      EXPECT_FALSE(fs::exists(Out()) || fs::exists(Out().string() + ".incomplete"));
      return fault.what();
    }
    return "no fault";
  }
  static std::string Table(const std::string& topic, const std::string& column) {
    return "tables: [{name: t, topic: '" + topic + "', columns: {v: {column: '" + column +
           "', unit: '1'}}}]\n";
  }
  TableRecording Read() const { return Recording(Out()).LoadTable("rover/t.csv"); }
  fs::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
};

TEST_F(UlogTest, NumbersAreFoundByTheirPaths) {
  Log(Whole().bytes());
  Import(Table("sensor_combined", "gyro_rad[2]"));
  EXPECT_THAT(Read().t_ns, ElementsAre(2'000'000'000, 2'010'000'000));
  EXPECT_EQ(Read().rows[1][0], 2);
  Import(Table("sensor_combined[1]", "gyro_rad[2]"));
  EXPECT_THAT(Read().t_ns, ElementsAre(2'000'500'000));
  Import(Table("escs", "esc[0].rpm"));
  EXPECT_EQ(Read().rows[0][0], -300);
  Import(Table("escs", "esc[0].on"));
  EXPECT_EQ(Read().rows[0][0], 1);
  Import(Table("escs", "level"));
  EXPECT_EQ(Read().rows[0][0], 2.5);
}

TEST_F(UlogTest, ASuggestionComesInWithAxesForwardLeftAndUp) {
  Log(Whole().bytes());
  const std::string yaml = SuggestMapping(scratch_.path() / "log.ulg");
  EXPECT_THAT(yaml, HasSubstr("# not imported: escs, 1 messages"));
  WriteWholeFile(scratch_.path() / "mapping.yaml", yaml);
  ImportCsv(scratch_.path() / "mapping.yaml", Out());
  const auto imu = Recording(Out()).LoadImu("machine/sensor_combined");
  ASSERT_EQ(imu.size(), 2u);
  EXPECT_EQ(imu[0].t_ns, 0);
  EXPECT_TRUE(imu[0].w_WS_S_radps.isApprox(Vec3(0.25, 0.5, -1), 1e-12));
  EXPECT_TRUE(imu[0].f_S_mps2.isApprox(Vec3(0.5, -1.5, 9.75), 1e-12));  // at rest +g along z
}

// Both spellings of a receiver's fields after a message without a fix; the bytes decide,
// independent of the name.
TEST_F(UlogTest, TheSuggestedOriginIsTheFirstFixAboveTheEllipsoid) {
  const auto newer = [](std::uint64_t t_us, std::uint8_t fix, double lat_deg) {
    return Bytes(t_us) + Bytes(lat_deg) + Bytes(fix == 0 ? 0.0 : 8.5) +
           Bytes(fix == 0 ? 0.0 : 488.0) + Bytes(fix);
  };
  const auto older = [](std::uint64_t t_us, std::uint8_t fix, double lat_deg) {
    return Bytes(t_us) + Bytes(static_cast<std::int32_t>(std::lround(lat_deg * 1e7))) +
           Bytes(std::int32_t{fix == 0 ? 0 : 85'000'000}) +
           Bytes(std::int32_t{fix == 0 ? 0 : 488'000}) + Bytes(fix);
  };
  const std::string newer_format =
      "vehicle_gps_position:uint64_t timestamp;double latitude_deg;double longitude_deg;double "
      "altitude_ellipsoid_m;uint8_t fix_type;";
  const std::string older_format =
      "vehicle_gps_position:uint64_t timestamp;int32_t lat;int32_t lon;int32_t "
      "alt_ellipsoid;uint8_t "
      "fix_type;";
  for (const bool is_newer : {true, false}) {
    Ulog log;
    log.Format(is_newer ? newer_format : older_format).Offer(1, "vehicle_gps_position");
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t t_us = 1'000'000 + 200'000 * static_cast<std::uint64_t>(k);
      const std::uint8_t fix = k == 0 ? 0 : 3;
      log.Data(1, is_newer ? newer(t_us, fix, k == 0 ? 0 : 47.375)
                           : older(t_us, fix, k == 0 ? 0 : 47.375));
    }
    WriteWholeFile(scratch_.path() / "flight.bin", log.bytes());
    WriteWholeFile(scratch_.path() / "mapping.yaml",
                   SuggestMapping(scratch_.path() / "flight.bin"));
    fs::remove_all(Out());
    ImportCsv(scratch_.path() / "mapping.yaml", Out());
    const auto fixes = Recording(Out()).LoadGnss("machine/vehicle_gps_position");
    ASSERT_EQ(fixes.size(), 2u);
    EXPECT_NEAR(fixes[0].alt_m, 488, 1e-9);
    EXPECT_NEAR(fixes[0].enu_m.norm(), 0, 1e-2);
  }
  Ulog none;
  none.Format(newer_format).Offer(1, "vehicle_gps_position").Data(1, newer(1'000'000, 0, 0));
  Log(none.bytes());
  EXPECT_THAT(SuggestMapping(scratch_.path() / "log.ulg"),
              AllOf(HasSubstr("# not imported: vehicle_gps_position, no message has a fix"),
                    testing::Not(HasSubstr("origin"))));
}

TEST_F(UlogTest, TopicsAndFieldsThatAreMissingAreNamed) {
  Log(Whole().bytes());
  EXPECT_THAT(FaultOf(Table("sensor_combine", "x")),
              AllOf(HasSubstr("log.ulg: has no topic 'sensor_combine' (did you mean "
                              "'sensor_combined'?)"),
                    HasSubstr("it has escs, sensor_combined, sensor_combined[1]")));
  EXPECT_THAT(FaultOf(Table("escs", "esc[2].rpm")),
              AllOf(HasSubstr("escs has no 'esc[2].rpm'"), HasSubstr("esc[1].rpm")));
  EXPECT_THAT(FaultOf(Table("sensor_combined", "_padding0[0]")),
              HasSubstr("has no '_padding0[0]'"));
  EXPECT_THAT(FaultOf("imus: [{name: imu}]\n"), HasSubstr("topic"));
}

// The readable part of a truncated log is read on request.
TEST_F(UlogTest, ALogThatWasCutOffIsAFaultOrCounted) {
  const std::string whole = Whole().bytes();
  for (const std::size_t less : {1u, 20u, 33u, 34u}) {
    Log(whole.substr(0, whole.size() - less));
    EXPECT_THAT(FaultOf(Table("sensor_combined", "gyro_rad[0]")),
                AllOf(HasSubstr("the log ends within a message"), HasSubstr("--skip-bad-rows")));
    const ImportReport report =
        Import(Table("sensor_combined", "gyro_rad[0]"), {.skips_bad_rows = true});
    EXPECT_EQ(report.channels[0].rows, 1);
    EXPECT_EQ(report.channels[0].left_out, 1);
  }
}

// Data appended after a truncation lies at the flags' offsets.
TEST_F(UlogTest, AppendedDataIsRead) {
  Ulog begin;
  const std::size_t flags = begin.bytes().size() + 3 + 16;
  begin.Flags(0, 1, 0).Format(kImu).Offer(3, "sensor_combined").Data(3, ImuRow(1'000'000, 1));
  begin.Raw(Bytes(std::uint16_t{34}) + "D" + "cut off");
  std::string bytes = begin.bytes();
  const std::uint64_t at = bytes.size();
  std::memcpy(bytes.data() + flags, &at, sizeof at);
  Ulog more;
  more.Data(3, ImuRow(2'000'000, 2));
  Log(bytes + more.bytes().substr(16));
  Import(Table("sensor_combined", "gyro_rad[2]"));
  EXPECT_THAT(Read().t_ns, ElementsAre(1'000'000'000, 2'000'000'000));
}

TEST_F(UlogTest, WhatIsNoLogOrOfALaterVersionIsRefused) {
  const std::string keys = Table("sensor_combined", "gyro_rad[0]");
  Log("");
  EXPECT_THAT(FaultOf(keys), HasSubstr("log.ulg: is not a ULog"));
  Log("\x55\x4c\x6f\x67");
  EXPECT_THAT(FaultOf(keys), HasSubstr("is not a ULog"));
  Log(Ulog(2).bytes());
  EXPECT_THAT(FaultOf(keys), HasSubstr("is a ULog of version 2; need version 0 or 1"));
  Log(Ulog().Flags(0, 2, 0).bytes());
  EXPECT_THAT(FaultOf(keys), HasSubstr("needs a reader of a later version"));
}

TEST_F(UlogTest, HostileBytesAreFaults) {
  const std::string keys = Table("t", "a");
  const auto fault = [&](const Ulog& log) {
    Log(log.bytes());
    return FaultOf(keys);
  };
  const std::string time = Bytes(std::uint64_t{1});
  EXPECT_THAT(fault(Ulog().Data(7, time)), HasSubstr("data of an undeclared topic"));
  EXPECT_THAT(fault(Ulog().Offer(1, "t").Data(1, time)), HasSubstr("no definition of t"));
  EXPECT_THAT(fault(Ulog().Format("t:t a;").Offer(1, "t").Data(1, time)),
              HasSubstr("a format that holds itself"));
  EXPECT_THAT(fault(Ulog()
                        .Format("t:b[60000] a;")
                        .Format("b:c[60000] a;")
                        .Format("c:")
                        .Offer(1, "t")
                        .Data(1, time)),
              HasSubstr("a format that no message can hold"));
  // Each of 65 535 numbers has a path of up to 60 kB, which together would fill four gigabytes.
  const std::string long_name(60000, 'a');
  EXPECT_THAT(
      fault(Ulog().Format("t:uint8_t[65535] " + long_name + ";").Offer(1, "t").Data(1, time)),
      HasSubstr("a field with an invalid name"));
  EXPECT_THAT(fault(Ulog().Format("t:float[0] a;").Offer(1, "t").Data(1, time)),
              HasSubstr("an array without a length"));
  EXPECT_THAT(fault(Ulog().Format("t:float a;").Offer(1, "t").Data(1, time)),
              HasSubstr("has no 'timestamp'"));
  EXPECT_THAT(fault(Ulog().Format("no colon")), HasSubstr("a format without a name"));
  EXPECT_THAT(fault(Ulog().Message('D', "x")), HasSubstr("without a topic"));
  EXPECT_THAT(fault(Ulog().Raw(Bytes(std::uint16_t{1}) + "\xff\xff")),
              HasSubstr("bytes that are not a message"));
  Ulog sound;
  sound.Format("t:uint64_t timestamp;float a;").Offer(1, "t");
  EXPECT_THAT(fault(Ulog(sound).Data(1, time + "ab")), HasSubstr("is shorter than its fields"));
  EXPECT_THAT(fault(Ulog(sound).Data(1, Bytes(~std::uint64_t{0}) + Bytes(1.0f))),
              HasSubstr("its timestamp is no time"));
  EXPECT_THAT(fault(Ulog(sound).Data(1, time + Bytes(std::nanf("")))),
              HasSubstr("is not a number"));
  const std::string later = Bytes(std::uint64_t{9}) + Bytes(1.0f);
  EXPECT_THAT(fault(Ulog(sound).Data(1, later).Data(1, time + Bytes(1.0f))),
              HasSubstr("need a later time"));
}

}  // namespace
}  // namespace tera
