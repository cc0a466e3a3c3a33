#include "dataset/import/suggest/suggested_table.h"

// Suggestions for tables by loggers, spreadsheets, databases and NumPy. Each is run.

namespace tera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

// --- The time base.

TEST_F(SuggestedTable, ALineOfUnitsIsNoRowAndItsUnitsAreTaken) {
  ExpectFiftyHertz(Joints("Time,Boom\ns,deg\n0.00,20\n0.02,20.1\n0.04,20.2\n"));
  EXPECT_THAT(yaml_, AllOf(HasSubstr("csv: {unit_lines: 1}\ntime: {column: Time, unit: s}\n"),
                           HasSubstr("{name: boom, angle: {column: Boom, unit: deg}}\n")));
  ExpectFiftyHertz(Joints("Time;Boom;p\n[ms];[°];[1]\n0;20;3\n20;20.1;3\n40;20.2;3\n"));
  EXPECT_THAT(yaml_, HasSubstr("time: {column: Time, unit: ms}\n"));
}

TEST_F(SuggestedTable, UnitsOfPressuresAndForcesAreTaken) {
  const Recording recording =
      Imported("Time,p,F,Temp\ns,psi,kN,°C\n0.00,100,2,20\n0.02,200,3,20\n");
  const TableRecording table = recording.LoadTable("machine/others.csv");
  // A pound force of 4.4482216152605 N on an inch of 0.0254 m squared.
  EXPECT_NEAR(table.rows[0][0], 100 * 4.4482216152605 / (0.0254 * 0.0254), 1e-3);
  EXPECT_EQ(table.rows[1][1], 3000);
  EXPECT_THAT(yaml_, HasSubstr("Temp: {column: Temp, unit: '1'}   # guessed: in °C, up to 20\n"));
}

TEST_F(SuggestedTable, ACounterIsNoTimeAndARepeatedStampIsLeftOut) {
  const EncoderRecording joints = Joints(
      "seq,time_s,boom_deg\n0,0.00,20\n1,0.02,20.1\n2,0.02,20.1\n3,0.04,20.2\n4,0.06,20\n"
      "5,0.08,20\n");
  ASSERT_EQ(joints.samples.size(), 5u);
  EXPECT_EQ(joints.samples[2].t_ns, 40'000'000);
  EXPECT_THAT(yaml_, AllOf(HasSubstr("time: {column: time_s, unit: s}\n# line 4 repeats the time"),
                           HasSubstr("valid_if: [{column: time_s, changes: true}]\n")));
}

TEST_F(SuggestedTable, AStampThatGoesBackIsToldAndIsTheTime) {
  Suggest("seq,time_s,boom_deg\n0,0.00,20\n1,0.02,20.1\n2,0.01,20.1\n3,0.04,20.2\n");
  EXPECT_THAT(
      yaml_,
      HasSubstr("time: {column: time_s, unit: s}\n# line 4 is earlier than the previous row"));
}

TEST_F(SuggestedTable, WhatAlwaysIncreasesIsNoTimeByThatAlone) {
  for (const std::string name : {"boom_deg", "odometer_m", "Engine Hours", "seq", "index",
                                 "counter", "Unnamed: 0", "frame", "cycle_time", "fuel_used"}) {
    EXPECT_THAT(Refusal(name + ",bucket\n1,20\n2,21\n3,19\n"),
                HasOnlyFault(FaultKind::kMissing, "mapping.yaml:5:7: time"))
        << name;
    EXPECT_THAT(yaml_,
                HasSubstr("'" + name + "' always increases, by 1, but its name is not that of a"));
  }
  // The first column without a name, as in pandas' index.
  EXPECT_THAT(Refusal(",boom\n0,20\n1,21\n2,19\n"), HasFault(FaultKind::kMissing, "time"));
}

TEST_F(SuggestedTable, ATimeWithoutAUnitIsTakenWhereItsFractionsTell) {
  ExpectFiftyHertz(Joints("t,boom\n0.00,20\n0.02,20.1\n0.04,20.2\n"));
  EXPECT_THAT(yaml_, HasSubstr("time: {column: t, unit: s}   # guessed: steps of 0.02 with"));
  EXPECT_THAT(Refusal("t,boom\n0,20\n20,20.1\n40,20.2\n"),
              HasOnlyFault(FaultKind::kNoSuchName, "mapping.yaml:5:25: time.unit"));
  EXPECT_THAT(yaml_, HasSubstr("# to fill in: its unit is unknown; it steps by 20, at 0.05 Hz in "
                               "s or 50 Hz in ms\n"));
}

TEST_F(SuggestedTable, NamesOfTimesInOtherLanguagesAreKnown) {
  for (const std::string name :
       {"Zeit [s]", "Zeitstempel_s", "temps (s)", "Tiempo [sec]", "Timestamp (s)", "elapsed_sec",
        "seconds", "Time_sec", "t [s]", "System Time (sec)"}) {
    ExpectFiftyHertz(Joints("n," + name + ",boom_deg\n0,0.00,20\n1,0.02,20.1\n2,0.04,20.2\n"));
  }
  ExpectFiftyHertz(Joints("timeMs,boom_deg\n0,20\n20,20.1\n40,20.2\n"));
}

TEST_F(SuggestedTable, DatesAreTheTimeInEachOfTheirForms) {
  for (const auto& [first, second, third] :
       {std::tuple{"2024-05-01T12:34:59.980Z", "2024-05-01T12:35:00.000Z",
                   "2024-05-01T12:35:00.020Z"},
        {"2024-05-01 12:34:59.98", "2024-05-01 12:35:00", "2024-05-01 12:35:00.02"},
        {"01.05.2024 12:34:59.980", "01.05.2024 12:35:00.000", "01.05.2024 12:35:00.020"},
        {"2024/05/01 12:34:59.98+02:00", "2024/05/01 12:35:00+02:00",
         "2024/05/01 12:35:00.02+02:00"},
        {"12:34:59.980", "12:35:00.000", "12:35:00.020"}}) {
    ExpectFiftyHertz(Joints(fmt::format("timestamp,boom_deg,n\n{},20,1\n{},20.1,2\n{},20.2,3\n",
                                        first, second, third)));
  }
  EXPECT_THAT(Suggest("timestamp,boom_deg\n2024-05-01T12:34:59Z,20\n2024-05-01T12:35:00Z,21\n"),
              HasSubstr("time: {date: timestamp}\nzero: start\n"));
  EXPECT_THAT(Suggest("timestamp,boom_deg\n2024-05-01 12:34:59,20\n2024-05-01 12:35:00,21\n"),
              HasSubstr("time: {date: timestamp}   # guessed: no zone is given, taken as UTC; "
                        "otherwise set zone: \"+01:00\"\n"));
}

TEST_F(SuggestedTable, DateAndClockInTwoColumnsAreOneTime) {
  ExpectFiftyHertz(
      Joints("Date;Time;Boom [deg]\n31.12.2023;23:59:59.980;20\n01.01.2024;00:00:00.000;20.1\n"
             "01.01.2024;00:00:00.020;20.2\n"));
  EXPECT_THAT(yaml_, HasSubstr("time: {date: Date, clock: Time}"));
}

TEST_F(SuggestedTable, DayAndMonthAreToldApartOrAskedFor) {
  ExpectFiftyHertz(
      Joints("time,boom_deg\n05/14/2024 12:34:59.980,20\n05/14/2024 12:35:00.000,20.1\n"
             "05/14/2024 12:35:00.020,20.2\n"));
  EXPECT_THAT(yaml_, HasSubstr("time: {date: time, order: mdy}"));
  EXPECT_THAT(Refusal("time,boom_deg\n05/01/2024 12:34:59,20\n05/01/2024 12:35:00,20.1\n"),
              HasFault(FaultKind::kNoSuchName, "time.order"));
  EXPECT_THAT(yaml_, HasSubstr("# to fill in: no row shows whether day or month is first\n"));
}

TEST_F(SuggestedTable, TimesOfOtherEpochsAreKnownByTheirSize) {
  // 638501636960000000 counts 100 ns since the year 1 to 2024-05-01T12:34:56, as in .NET.
  for (const std::string row :
       {"1714566896.00,1714566896.02,1714566896.04", "1714566896000,1714566896020,1714566896040",
        "1714566896000000,1714566896020000,1714566896040000",
        "1714566896000000000,1714566896020000000,1714566896040000000"}) {
    const std::size_t first = row.find(','), second = row.rfind(',');
    ExpectFiftyHertz(
        Joints(fmt::format("stamp,boom_deg\n{},20\n{},20.1\n{},20.2\n", row.substr(0, first),
                           row.substr(first + 1, second - first - 1), row.substr(second + 1))));
    EXPECT_THAT(yaml_, HasSubstr("zero: start\n"));
  }
  const EncoderRecording joints = Joints(
      "time,boom_deg\n638501636960000000,20\n638501636960200000,20.1\n638501636960400000,20.2\n");
  EXPECT_NEAR(ToSeconds(joints.samples.at(2).t_ns), 0.04, 1e-4);
}

TEST_F(SuggestedTable, StampsOfTwoColumnsAreOneTime) {
  ExpectFiftyHertz(
      Joints("stamp.sec,stamp.nanosec,boom_deg\n1714566896,980000000,20\n1714566897,0,20.1\n"
             "1714566897,20000000,20.2\n"));
  ExpectFiftyHertz(
      Joints("GPS Week,TOW [s],boom_deg\n2312,304517.98,20\n2312,304518.00,20.1\n"
             "2312,304518.02,20.2\n"));
}

TEST_F(SuggestedTable, HoursMinutesAndSecondsInColumnsOfTheirOwnAreOneTime) {
  ExpectFiftyHertz(
      Joints("hour,minute,sec,boom_deg\n9,59,59.98,20\n10,0,0,20.1\n10,0,0.02,20.2\n"));
  ExpectFiftyHertz(Joints("Minute,Sec,boom_deg\n3,59.98,20\n4,0,20.1\n4,0.02,20.2\n"));
}

TEST_F(SuggestedTable, MillisecondsOfAFastLoggerAreNoSeconds) {
  EXPECT_THAT(Refusal("t,boom\n0.000,20\n0.001,20.1\n0.002,20.2\n"),
              HasFault(FaultKind::kNoSuchName, "time.unit"));
  EXPECT_THAT(yaml_, HasSubstr("it steps by 0.001, at 1000 Hz in s"));
  // 22 hours in seconds, 80 seconds in milliseconds.
  std::string log = "t,boom\n";
  for (int k = 0; k < 200; ++k)
    log += fmt::format("{:.1f},20\n", k < 100 ? 0.5 * k : 8e4 + 0.5 * k);
  EXPECT_THAT(Suggest(log),
              HasSubstr("{column: t, unit: unknown}   # to fill in: its unit is unknown"));
}

TEST_F(SuggestedTable, SecondsOfGpsTimeAreNotThoseSince1970) {
  EXPECT_THAT(Refusal("gps_time_s,boom_deg\n1398601714.00,20\n1398601714.02,20.1\n"),
              HasFault(FaultKind::kNoSuchName, "time.unit"));
  EXPECT_THAT(yaml_, HasSubstr("need offset: 315964782"));
  EXPECT_THAT(Suggest("gps_time_s,boom_deg\n1714566896.00,20\n1714566896.02,20.1\n"),
              HasSubstr("time: {column: gps_time_s, unit: s}\n"));
}

TEST_F(SuggestedTable, WeeksOfGpsTimeStandBesideEachNameOfTheirSeconds) {
  for (const std::string name : {"gps_tow_s", "tow", "tow_s", "gps_tow"}) {
    ExpectFiftyHertz(Joints("gps_week," + name +
                            ",boom_deg\n2312,604799.98,20\n2313,0.00,20.1\n"
                            "2313,0.02,20.2\n"));
    EXPECT_THAT(yaml_, HasSubstr("time: {week: gps_week, column: " + name + ", unit: s}")) << name;
  }
}

TEST_F(SuggestedTable, ADateBesideAClockIsAskedForItsOrder) {
  EXPECT_THAT(Refusal("\"Date\",\"Time\",\"Boom [deg]\"\n"
                      "\"06/03/2025\",\"10:00:00.000 AM\",20\n"
                      "\"06/03/2025\",\"10:00:00.020 AM\",20.1\n"
                      "\"06/03/2025\",\"10:00:00.040 AM\",20.2\n"),
              HasFault(FaultKind::kNoSuchName, "time.order"));
  EXPECT_THAT(yaml_, HasSubstr("time: {date: Date, clock: Time, order: unknown}"));
}

TEST_F(SuggestedTable, StampsTooCoarseForTheirRowsAreNoTime) {
  EXPECT_THAT(Refusal("time,boom_deg\n12:00:00,20\n12:00:00,20.1\n12:00:00,20.2\n12:00:01,20.3\n"),
              HasFault(FaultKind::kMissing, "time"));
  EXPECT_THAT(yaml_, HasSubstr("of 4 rows 2 repeat"));
}

// --- How tables are written.

TEST_F(SuggestedTable, NamesBehindAHashAreNames) {
  ExpectFiftyHertz(Joints("# time_s,boom_deg\n0.00,20\n0.02,20.1\n0.04,20.2\n"));
  EXPECT_THAT(yaml_, Not(HasSubstr("csv:")));
  ExpectFiftyHertz(
      Joints("#time_s boom_deg\n0.00e+00 2.00e+01\n2.0e-02 2.01e+01\n4e-02 2.02e+01\n"));
  ExpectFiftyHertz(
      Joints("# a logger, of 2011\n% time_s,boom_deg\n0.00,20\n0.02,20.1\n0.04,20.2\n"));
  EXPECT_THAT(yaml_, HasSubstr("csv: {skip_lines: 1}\n"));
}

TEST_F(SuggestedTable, EurocsInertialUnitIsOne) {
  const Recording recording = Imported(
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m "
      "s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n1400000000000000000,0.01,0.02,30,0.1,0.2,9.8\n"
      "1400000000005000000,0.01,0.02,30,0.1,0.2,9.8\n");
  const auto imu = recording.LoadImu("machine/imu");
  ASSERT_EQ(imu.size(), 2u);
  EXPECT_EQ(imu[1].t_ns, 5'000'000);
  EXPECT_EQ(imu[0].w_WS_S_radps.z(), 30);
  EXPECT_EQ(imu[0].f_S_mps2.z(), 9.8);
}

TEST_F(SuggestedTable, DecimalCommasAreFound) {
  ExpectFiftyHertz(Joints("Zeit [s];Ausleger [deg]\n0,00;20,00\n0,02;20,10\n0,04;20,20\n"));
  EXPECT_THAT(yaml_, HasSubstr("csv: {decimal: \",\"}\n"));
  ExpectFiftyHertz(
      Joints("\"t_s\",\"boom_deg\"\n\"0,00\",\"20,00\"\n\"0,02\",\"20,10\"\n"
             "\"0,04\",\"20,20\"\n"));
  ExpectFiftyHertz(Joints("t_s\tboom_deg\n0,00\t20,00\n0,02\t20,10\n0,04\t20,20\n"));
  const Recording recording = Imported("t_s;weight\n0,00;1.020,5\n0,02;950,5\n0,04;12.020,5\n");
  EXPECT_THAT(yaml_, HasSubstr("csv: {decimal: \",\", thousands: \".\"}\n"));
  EXPECT_EQ(recording.LoadTable("machine/others.csv").rows[2][0], 12020.5);
}

TEST_F(SuggestedTable, PreamblesAreSkipped) {
  // Forms of MoTeC, NI, Campbell and dSPACE.
  for (const std::string preamble :
       {"\"Format\",\"CSV File\",,,\"Workbook\",\"x\"\n\"Rate\",\"50.000\",\"Hz\"\n\n"
        "\"Time\",\"Boom Angle\"\n\"s\",\"deg\"\n\n",
        "LabVIEW Measurement\nSeparator,Comma\nDate,2026/11/28\n***End_of_Header***\n\n"
        "Time,Boom Angle\ns,deg\n",
        "\"TOA5\",\"CR1000\",\"CR1000\",\"1234\",\"OS.1\"\n\"Time\",\"Boom Angle\"\n\"s\",\"deg\"\n"
        "\"\",\"Smp\"\n",
        "# file: run7\n# rate: 50 Hz\nTime [s],Boom Angle [deg]\n",
        "logger 7\nsamples,3\nTime (s),Boom Angle (deg)\n"}) {
    ExpectFiftyHertz(Joints(preamble + "0.00,20\n0.02,20.1\n0.04,20.2\n"));
    EXPECT_THAT(yaml_, HasSubstr("skip_lines: ")) << preamble;
  }
}

TEST_F(SuggestedTable, ARowOfAnotherWidthMakesNoPreambleOfTheRowsAboveIt) {
  for (const std::string odd : {"0.38;21.9;7", "0.38", "0.38;ERR"}) {
    for (const std::string names : {"time_s;boom_deg\n", ""}) {
      std::string log = names;
      for (int k = 0; k < 60; ++k) {
        log += k == 19 ? odd + "\n" : fmt::format("{:.2f};{:.1f}\n", 0.02 * k, 20 + 0.1 * k);
      }
      EXPECT_THAT(Suggest(log), Not(HasSubstr("skip_lines"))) << odd;
      EXPECT_EQ(yaml_.find("header: false") == std::string::npos, !names.empty()) << yaml_;
    }
  }
}

TEST_F(SuggestedTable, GivenKeysCountAndOthersAreRefused) {
  const std::string log = "Time,Boom\nx,y\n0.00,20\n0.02,20.1\n0.04,20.2\n";
  EXPECT_THAT(Suggest(log, {"csv.skip_lines=2", "csv.header=false"}),
              AllOf(HasSubstr("csv: {skip_lines: 2, header: false}"), HasSubstr("time: unknown")));
  EXPECT_THAT([&] { Suggest(log, {"machine=digger"}); },
              ThrowsFault(FaultKind::kUnknown, "machine"));
  WriteWholeFile(scratch_.path() / "log.nmea", "");
  EXPECT_THAT([&] { SuggestMapping(scratch_.path() / "log.nmea", {"csv.skip_lines=2"}); },
              ThrowsFault(FaultKind::kUnsupported, "--set csv.skip_lines=2"));
}

TEST_F(SuggestedTable, LongTablesBecomeAChannelASignal) {
  const Recording recording = Imported(
      "time_s,signal,value\n0.000,boom,20\n0.005,arm,-60\n0.010,p main [bar],3\n0.020,boom,20.1\n"
      "0.025,arm,-61\n0.030,p main [bar],4\n0.040,boom,20.2\n");
  ExpectFiftyHertz(recording.LoadEncoder("machine/boom"));
  EXPECT_NEAR(recording.LoadEncoder("machine/arm").samples.at(1).q_rad[0], -61 * kDeg, 1e-12);
  EXPECT_EQ(recording.LoadTable("machine/p_main_bar.csv").rows.at(1).at(0), 4e5);
}

TEST_F(SuggestedTable, AColumnOfWordsAndWhatHasGapsStandsInNoWay) {
  const Recording recording = Imported(
      "time_s,state,boom_deg,fuel,rpm_x\n0.00,idle,20,,1\n0.02,dig,20.1,7,\n0.04,dig,20.2,,"
      "2\n");
  ExpectFiftyHertz(recording.LoadEncoder("machine/joints"));
  EXPECT_EQ(recording.LoadTable("machine/others.csv").rows.size(), 1u);
  EXPECT_EQ(recording.LoadTable("machine/others_2.csv").rows.size(), 2u);
  EXPECT_THAT(yaml_, HasSubstr("# no numbers: state\n"));
}

TEST_F(SuggestedTable, WhatHasNoNumbersBesideItsTimeIsTold) {
  EXPECT_THAT([&] { Suggest("time_s,state\n0.00,idle\n0.02,dig\n0.04,dig\n"); },
              ThrowsFault(FaultKind::kMissing, "log.csv"));
}

TEST_F(SuggestedTable, EndingsOfNamesAreUnits) {
  Suggest(
      "t_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,acc_x_g,acc_y_g,acc_z_g,lat_rad,lon_rad,alt_m\n"
      "0.00,1,2,3,0.1,0.2,2.5,0.816,-1.244,90\n0.02,1,2,3,0.1,0.2,2.5,0.816,-1.244,90\n");
  EXPECT_THAT(yaml_, AllOf(HasSubstr("wx: {column: gyro_x_dps, unit: deg/s}\n"),
                           HasSubstr("az: {column: acc_z_g, unit: g}\n"),
                           HasSubstr("lat: {column: lat_rad, unit: rad}\n"),
                           HasSubstr("alt: {column: alt_m, unit: m}\n")));
  Suggest("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0.00,1,2,3,1,0,0,0\n0.02,1,2,3,1,0,0,0\n");
  EXPECT_THAT(yaml_, AllOf(HasSubstr("pose:\n"), HasSubstr("x: {column: x_m, unit: m}\n")));
}

// --- Levers and set-points.

TEST_F(SuggestedTable, PulsesOfServosAreLevers) {
  const Recording recording =
      Imported("time_s,boom_cmd,arm_joystick\n0.00,1000,1500\n0.02,1500,1500\n0.04,2000,1750\n");
  const auto rows = recording.LoadTable("machine/commands.csv").rows;
  EXPECT_NEAR(rows[0][0], -1, 1e-12);
  EXPECT_NEAR(rows[1][0], 0, 1e-12);
  EXPECT_NEAR(rows[2][1], 0.5, 1e-12);
  EXPECT_THAT(yaml_, HasSubstr("# guessed: pulses of 1000 to 2000 us, at rest 1500"));
}

TEST_F(SuggestedTable, OppositeLeversAreOne) {
  const Recording recording = Imported(
      "time_s,boom_up_cmd,boom_down_cmd,lever_left_track,lever_right_track\n0.00,50,0,1,2\n"
      "0.02,0,100,3,4\n");
  const TableRecording table = recording.LoadTable("machine/commands.csv");
  EXPECT_THAT(table.columns, testing::ElementsAre("boom", "left_track", "right_track"));
  EXPECT_NEAR(table.rows[0][0], 0.5, 1e-12);
  EXPECT_NEAR(table.rows[1][0], -1, 1e-12);
}

TEST_F(SuggestedTable, SetPointsByTheirNamesAreNoLevers) {
  const Recording recording = Imported(
      "time_s,left_speed_cmd [m/s],boom_ref_deg,bucketSollwert [bar],lift_joystick,arm_setpoint,"
      "boom_deg\n0.00,1,20,3,0.5,-0.1,20\n0.02,2,20,3,0.5,0.2,20\n0.04,2,20,3,0.5,0.2,20\n");
  EXPECT_THAT(recording.LoadTable("machine/commands.csv").columns,
              testing::ElementsAre("lift", "arm"));
  const TableRecording setpoints = recording.LoadTable("machine/setpoints.csv");
  ASSERT_EQ(setpoints.columns.size(), 3u);
  EXPECT_EQ(setpoints.rows[1][0], 2);
  EXPECT_NEAR(setpoints.rows[0][1], 20 * kDeg, 1e-12);
  EXPECT_EQ(setpoints.rows[0][2], 3e5);
  EXPECT_EQ(recording.LoadEncoder("machine/joints").axes.size(), 1u);
}

TEST_F(SuggestedTable, AStrokeOrAPressureOfAJointIsNoAngle) {
  Imported("time_s,boom [bar],arm_mm,bucket_deg\n0.00,1,2,3\n0.02,1,2,3\n");
  EXPECT_THAT(yaml_, AllOf(HasSubstr("boom_bar: {column: \"boom [bar]\", unit: bar}"),
                           HasSubstr("arm_mm: {column: arm_mm, unit: mm}"),
                           HasSubstr("{name: bucket, angle: {column: bucket_deg, unit: deg}}")));
}

TEST_F(SuggestedTable, WhatIsNoTableIsRefused) {
  for (const std::string& first : {std::string("\xd4\xc3\xb2\xa1\x02\0\x04\0", 8),
                                   std::string("PK\x03\x04[Content_Types].xml"),
                                   std::string("     3.04           OBSERVATION DATA    M: Mixed   "
                                               "         RINEX VERSION / TYPE\n")}) {
    EXPECT_THAT([&] { Suggest(first); }, ThrowsFault(FaultKind::kUnsupported, "log.csv"));
  }
}

TEST_F(SuggestedTable, FilesWithoutRowsAreRefused) {
  for (const std::string text : {"", "\n\n", "time_s,boom_deg\n", "time_s,boom_deg\r\n\r\n"}) {
    EXPECT_THAT([&] { Suggest(text); }, ThrowsFault(FaultKind::kMissing, "log.csv")) << text;
  }
}

}  // namespace
}  // namespace tera
