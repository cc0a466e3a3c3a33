#include "dataset/format/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using testing::HasSubstr;

/// A finished sample recording.
class RecordingTest : public testing::Test {
 protected:
  RecordingTest() { WriteWholeSample(directory(), {}); }
  std::filesystem::path directory() const { return scratch_.path() / "run"; }
  Recording Open() const { return Recording(directory()); }
  /// Replaces the first `from` in a file.
  void Edit(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = ReadWholeFile(directory() / file);
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << file << " lacks " << from;
    WriteWholeFile(directory() / file, text.replace(place, from.size(), to));
  }

  ScratchDirectory scratch_;
};

TEST_F(RecordingTest, KnowsWhatItHolds) {
  const Recording recording = Open();
  EXPECT_TRUE(recording.info().simulated);
  EXPECT_EQ(recording.info().scenario_name, "two \"words\"");
  EXPECT_EQ(recording.info().seed, 7u);
  EXPECT_EQ(recording.info().origin_lon_deg, -71.27);
  EXPECT_EQ(recording.info().resolved_scenario_yaml, "seed: 7\n");
  ASSERT_EQ(recording.info().instances.size(), 2u);
  EXPECT_EQ(recording.info().instances[1].name, "person");
  EXPECT_EQ(recording.info().instances[1].parent, 0);
  EXPECT_THAT(recording.Machines(), testing::ElementsAre("digger"));
  EXPECT_THAT(recording.ChannelsOf(kCameraChannel), testing::ElementsAre("digger/front"));
  EXPECT_EQ(recording.channels().size(), 7u);
}

TEST_F(RecordingTest, AnInstanceNamesTheWholeThatItIsAPartOf) {
  const ScratchDirectory scratch;
  DatasetInfo info;
  info.scenario_name = "parts";
  info.instances = {{1, "m/boom", "boom", 3}, {2, "cone", "cone"}, {3, "m", "vehicle"}};
  DatasetWriter writer(scratch.path() / "parts", info, {});
  writer.Finish();
  EXPECT_THAT(ReadWholeFile(scratch.path() / "parts/dataset.yaml"),
              HasSubstr("  - {id: 1, name: \"m/boom\", class: boom, parent: 3}\n"
                        "  - {id: 2, name: \"cone\", class: cone}\n"));
  const Recording recording(scratch.path() / "parts");
  EXPECT_EQ(recording.info().instances[0].parent, 3);
  EXPECT_EQ(recording.info().instances[1].parent, 0);
}

TEST_F(RecordingTest, BoxesOfBeforeThereWereWholesStillRead) {
  Edit("digger/front/boxes/100000000.json", "   \"parent\": 1,\n", "");
  EXPECT_EQ(Open().LoadFrame("digger/front", kSamplePeriod_ns).boxes.at(0).parent, 0);
}

TEST_F(RecordingTest, NamesTheVersionOfTheProgramThatWroteIt) {
  EXPECT_THAT(TERA_PROJECT_VERSION, testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
  EXPECT_THAT(ReadWholeFile(directory() / "dataset.yaml"),
              HasSubstr("\ntera_version: \"" TERA_PROJECT_VERSION "\"\n"));
}

TEST_F(RecordingTest, ATableWithoutColumnsIsItsTimes) {
  // The joints of a machine without any.
  const ScratchDirectory scratch;
  DatasetInfo info;
  info.scenario_name = "mast";
  DatasetWriter writer(scratch.path() / "mast", info, {});
  const ChannelId joints = writer.AddChannel(TableChannel("truth/mast/joints.csv", {}));
  for (const TimeNs t_ns : {0, 10}) writer.Write(joints, RowSample{t_ns, t_ns, {}});
  writer.Finish();
  const auto table = Recording(scratch.path() / "mast").LoadTable("truth/mast/joints.csv");
  EXPECT_TRUE(table.columns.empty());
  EXPECT_THAT(table.t_ns, testing::ElementsAre(0, 10));
}

TEST_F(RecordingTest, GivesBackNumbersExactly) {
  const Recording recording = Open();
  const auto imu = recording.LoadImu("digger/imu");
  const auto gnss = recording.LoadGnss("digger/gnss");
  const auto encoder = recording.LoadEncoder("digger/joints");
  const auto table = recording.LoadTable("digger/commands.csv");
  ASSERT_EQ(imu.size(), static_cast<std::size_t>(kSampleFrames));
  for (int k = 0; k < kSampleFrames; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_EQ(imu[i].t_ns, SampleImu(k).t_ns);
    EXPECT_EQ(imu[i].w_WS_S_radps, SampleImu(k).w_WS_S_radps);
    EXPECT_EQ(imu[i].f_S_mps2, SampleImu(k).f_S_mps2);
    EXPECT_EQ(gnss[i].lat_deg, SampleGnss(k).lat_deg);
    EXPECT_EQ(gnss[i].lon_deg, SampleGnss(k).lon_deg);
    EXPECT_EQ(gnss[i].enu_m, SampleGnss(k).enu_m);
    EXPECT_EQ(gnss[i].fix, GnssFix::kRtkFloat);
    EXPECT_EQ(gnss[i].variance_enu_m2, SampleGnss(k).variance_enu_m2);
    EXPECT_EQ(encoder.samples[i].q_rad, SampleEncoder(k).q_rad);
    EXPECT_EQ(encoder.samples[i].qd_radps, SampleEncoder(k).qd_radps);
    EXPECT_THAT(table.rows[i], testing::ElementsAre(0.5, -1.0));
  }
  EXPECT_THAT(encoder.axes, testing::ElementsAre(EncoderAxis{"boom"}, EncoderAxis{"stick", true}));
  EXPECT_THAT(table.columns, testing::ElementsAre("boom", "arm"));
}

TEST_F(RecordingTest, GivesBackPosesWithTheirVelocities) {
  const PoseRecording pose = Open().LoadPose("truth/digger/pose.csv");
  EXPECT_TRUE(pose.has_velocity);
  for (int k = 0; k < kSampleFrames; ++k) {
    const TruthPose& read = pose.poses[static_cast<std::size_t>(k)];
    EXPECT_TRUE(read.X_WB.isApprox(SamplePose(k).X_WB, 1e-14));
    EXPECT_EQ(read.v_WB_mps, SamplePose(k).v_WB_mps);
    EXPECT_EQ(read.w_WB_B_radps, SamplePose(k).w_WB_B_radps);
  }
}

TEST_F(RecordingTest, GivesBackImagesPixelByPixelAndDepthToTheMillimetre) {
  const CameraFrame read = Open().LoadFrame("digger/front", 2 * kSamplePeriod_ns);
  const CameraFrame frame = SampleFrame(2);
  EXPECT_EQ(read.rgb.data, frame.rgb.data);
  EXPECT_EQ(read.rgb.channels, 3);
  EXPECT_EQ(read.semantic.data, frame.semantic.data);
  EXPECT_EQ(read.instance.data, frame.instance.data);
  ASSERT_EQ(read.depth_m.data.size(), frame.depth_m.data.size());
  for (std::size_t i = 0; i < read.depth_m.data.size(); ++i) {
    EXPECT_NEAR(read.depth_m.data[i], frame.depth_m.data[i], 1e-6);  // they are whole millimetres
  }
}

TEST_F(RecordingTest, GivesBackNormalsAloneAndNoOtherLabel) {
  ScratchDirectory scratch;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
  CameraFrame frame = SampleFrame(1);
  const auto camera = writer.AddChannel(CameraChannel("digger/front", "type: camera\n"));
  frame.semantic = {};
  frame.instance = {};
  frame.normal = Image<std::uint16_t>(33, 17, 3);
  for (std::size_t i = 0; i < frame.normal.data.size(); ++i) {
    frame.normal.data[i] = static_cast<std::uint16_t>(977 * i);
  }
  writer.Write(camera, frame);
  writer.Finish();
  const CameraFrame read = Recording(scratch.path() / "run").LoadFrame("digger/front", frame.t_ns);
  EXPECT_EQ(read.normal.channels, 3);
  EXPECT_EQ(read.normal.data, frame.normal.data);
  EXPECT_TRUE(read.semantic.empty());
  EXPECT_TRUE(read.instance.empty());
  EXPECT_TRUE(read.boxes.empty());
}

TEST_F(RecordingTest, GivesBackObjectBoxes) {
  const auto boxes = Open().LoadFrame("digger/front", kSamplePeriod_ns).boxes;
  const ObjectBox expected = SampleFrame(1).boxes[0];
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].name, "person");
  EXPECT_EQ(boxes[0].label, SemanticClass::kPerson);
  EXPECT_EQ(boxes[0].instance, 2);
  EXPECT_EQ(boxes[0].parent, 1);
  EXPECT_EQ(boxes[0].x_max_px, 12);
  EXPECT_EQ(boxes[0].visible_px, 60);
  EXPECT_EQ(boxes[0].visibility, 0.625);
  EXPECT_EQ(boxes[0].size_O_m, expected.size_O_m);
  EXPECT_TRUE(boxes[0].X_CO.isApprox(expected.X_CO, 1e-14));
}

TEST_F(RecordingTest, GivesBackScansBitByBit) {
  const LidarScan read = Open().LoadScan("digger/lidar", 3 * kSamplePeriod_ns);
  const LidarScan scan = SampleScan(3);
  ASSERT_EQ(read.points.size(), scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    EXPECT_EQ(read.points[i].x_m, scan.points[i].x_m);
    EXPECT_EQ(read.points[i].y_m, scan.points[i].y_m);
    EXPECT_EQ(read.points[i].intensity, scan.points[i].intensity);
    EXPECT_EQ(read.points[i].time_offset_ns, scan.points[i].time_offset_ns);
    EXPECT_EQ(read.points[i].ring, scan.points[i].ring);
    EXPECT_EQ(read.points[i].instance, scan.points[i].instance);
    EXPECT_EQ(read.points[i].label, scan.points[i].label);
  }
}

TEST_F(RecordingTest, CsvFilesHaveTheDocumentedColumns) {
  const auto first_line = [&](const std::string& file) {
    const std::string text = ReadWholeFile(directory() / file);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(first_line("digger/imu/data.csv"),
            "t_ns,wx_radps,wy_radps,wz_radps,ax_mps2,ay_mps2,az_mps2");
  EXPECT_EQ(first_line("digger/gnss/data.csv"),
            "t_ns,lat_deg,lon_deg,alt_m,east_m,north_m,up_m,fix,var_e_m2,var_n_m2,var_u_m2");
  EXPECT_EQ(first_line("digger/joints/data.csv"), "t_ns,boom_rad,stick_m,boom_radps,stick_mps");
  EXPECT_EQ(first_line("digger/front/data.csv"), "t_ns,filename");
  EXPECT_EQ(first_line("digger/commands.csv"), "t_ns,boom,arm");
  EXPECT_EQ(first_line("truth/digger/pose.csv"),
            "t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,wx_radps,wy_radps,wz_radps");
}

TEST_F(RecordingTest, RejectsATruncatedCsv) {
  const std::string text = ReadWholeFile(directory() / "digger/imu/data.csv");
  WriteWholeFile(directory() / "digger/imu/data.csv", text.substr(0, text.size() - 5));
  EXPECT_THAT([&] { Open().LoadImu("digger/imu"); }, ThrowsFault(kMalformed, "imu/data.csv:7"));
  WriteWholeFile(directory() / "digger/imu/data.csv", text + "600000000,1,2\n");
  EXPECT_THAT([&] { Open().LoadImu("digger/imu"); }, ThrowsFault(kMalformed, "imu/data.csv:8"));
}

TEST_F(RecordingTest, RejectsAListedFileThatIsNotThere) {
  std::filesystem::remove(directory() / "digger/commands.csv");
  EXPECT_THAT([&] { Open().LoadTable("digger/commands.csv"); },
              ThrowsFault(kUnreadable, "digger/commands.csv"));
}

TEST_F(RecordingTest, RejectsNumbersThatAreNotFinite) {
  Edit("digger/imu/data.csv", "9.80665", "nan");
  EXPECT_THAT([&] { Open().LoadImu("digger/imu"); }, ThrowsFault(kMalformed, "data.csv:2"));
}

TEST_F(RecordingTest, RejectsAMissingColumn) {
  Edit("digger/imu/data.csv", "wy_radps", "wy_degps");
  EXPECT_THAT([&] { Open().LoadImu("digger/imu"); }, ThrowsFault(kMalformed, "data.csv:1"));
}

TEST_F(RecordingTest, RejectsTimesThatDoNotIncrease) {
  Edit("digger/commands.csv", "200000000,", "100000000,");
  EXPECT_THAT([&] { Open().LoadTable("digger/commands.csv"); },
              ThrowsFault(kMalformed, "commands.csv:4"));
}

TEST_F(RecordingTest, RejectsAnEmptyCsvAFixOutsideNmeaAndAQuaternionOfAnotherNorm) {
  WriteWholeFile(directory() / "digger/imu/data.csv", "");
  EXPECT_THAT([&] { Open().LoadImu("digger/imu"); }, ThrowsFault(kMalformed, "imu/data.csv:1"));
  Edit("digger/gnss/data.csv", ",5,", ",3,");
  EXPECT_THAT([&] { Open().LoadGnss("digger/gnss"); }, ThrowsFault(kMalformed, "gnss/data.csv"));
  Edit("truth/digger/pose.csv", "\n0,1,2,-0.5,", "\n0,1,2,-0.5,1");
  EXPECT_THAT([&] { Open().LoadPose("truth/digger/pose.csv"); },
              ThrowsFault(kMalformed, "pose.csv:2"));
}

TEST_F(RecordingTest, RejectsAnEmptyOrTruncatedPng) {
  const auto file = directory() / "digger/front/rgb/0.png";
  const std::string png = ReadWholeFile(file);
  for (const std::size_t size : {std::size_t{0}, png.size() / 2, png.size() - 1}) {
    WriteWholeFile(file, png.substr(0, size));
    EXPECT_THAT([&] { Open().LoadFrame("digger/front", 0); }, ThrowsFault(kMalformed, "rgb/0.png"))
        << size << " bytes";
  }
}

// A PPM of one red pixel, followed by the end of a PNG: only PNG's decoder may read it.
TEST_F(RecordingTest, RejectsAPictureOfAnotherFormUnderThatName) {
  const auto file = directory() / "digger/front/rgb/0.png";
  const std::string png = ReadWholeFile(file);
  WriteWholeFile(file, "P6\n1 1\n255\n\xff\x01\x01" + png.substr(png.size() - 8));
  EXPECT_THAT([&] { Open().LoadFrame("digger/front", 0); }, ThrowsFault(kMalformed, "rgb/0.png"));
}

TEST_F(RecordingTest, RejectsAPngOfAnotherKind) {
  std::filesystem::copy_file(directory() / "digger/front/semantic/0.png",
                             directory() / "digger/front/depth/0.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT([&] { Open().LoadFrame("digger/front", 0); }, ThrowsFault(kMistyped, "depth/0.png"));
}

TEST_F(RecordingTest, RejectsATruncatedScan) {
  const auto file = directory() / "digger/lidar/scans/0.pcd";
  const std::string pcd = ReadWholeFile(file);
  for (const std::size_t size : {std::size_t{0}, std::size_t{40}, pcd.size() - 1}) {
    WriteWholeFile(file, pcd.substr(0, size));
    EXPECT_THAT([&] { Open().LoadScan("digger/lidar", 0); }, ThrowsFault(kMalformed, "scans/0.pcd"))
        << size << " bytes";
  }
}

TEST_F(RecordingTest, RejectsDamagedBoxes) {
  Edit("digger/front/boxes/0.json", "\"visibility\"", "\"visiblity\"");
  EXPECT_THAT([&] { Open().LoadFrame("digger/front", 0); },
              ThrowsFault(kMalformed, "boxes/0.json"));
}

TEST_F(RecordingTest, RejectsAFolderThatIsNoRecording) {
  EXPECT_THAT([&] { Recording(scratch_.path()); }, ThrowsFault(kMalformed));
}

TEST_F(RecordingTest, RejectsAFileAndSaysWhatMakesARecordingOfIt) {
  WriteWholeFile(scratch_.path() / "log.csv", "t,boom\n0,1\n");
  EXPECT_THAT([&] { Recording(scratch_.path() / "log.csv"); }, ThrowsFault(kUnreadable, "log.csv"));
}

TEST_F(RecordingTest, RejectsALabelOrderOfAnotherFormat) {
  Edit("dataset.yaml", "{id: 10, name: truck}", "{id: 10, name: person}");
  EXPECT_THAT([&] { Open(); }, ThrowsFault(kInconsistent, "classes[10].name"));
}

TEST(Pcd, HasTheHeaderThatPclReads) {
  ScratchDirectory scratch;
  WriterOptions options;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), options);
  const ChannelId lidar = writer.AddChannel(LidarChannel("m/lidar", ""));
  writer.Write(lidar, SampleScan(0, 2));
  writer.Finish();
  const std::string bytes = ReadWholeFile(scratch.path() / "run/m/lidar/scans/0.pcd");
  const std::string header =
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "VERSION 0.7\n"
      "FIELDS x y z intensity time ring instance label\n"
      "SIZE 4 4 4 4 4 2 2 1\n"
      "TYPE F F F F U U U U\n"
      "COUNT 1 1 1 1 1 1 1 1\n"
      "WIDTH 2\n"
      "HEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\n"
      "POINTS 2\n"
      "DATA binary_compressed\n";
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  // Two points of 25 bytes: the second little-endian word.
  EXPECT_EQ(bytes.substr(header.size() + 4, 4), std::string("\x32\0\0\0", 4));
}

TEST(Pcd, ScanWithoutReturnsIsAnEmptyCloud) {
  ScratchDirectory scratch;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
  const ChannelId lidar = writer.AddChannel(LidarChannel("m/lidar", ""));
  writer.Write(lidar, SampleScan(0, 0));
  writer.Finish();
  EXPECT_TRUE(Recording(scratch.path() / "run").LoadScan("m/lidar", 0).points.empty());
}

TEST(Depth, IsRoundedToMillimetresAndAbsentBeyondSixteenBits) {
  ScratchDirectory scratch;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
  const ChannelId camera = writer.AddChannel(CameraChannel("m/front", ""));
  CameraFrame frame;
  frame.depth_m = Image<float>(4, 1);
  frame.depth_m.data = {0.0f, 1.2344f, 1.2346f, 70.0f};
  writer.Write(camera, frame);
  writer.Finish();
  const CameraFrame read = Recording(scratch.path() / "run").LoadFrame("m/front", 0);
  EXPECT_THAT(read.depth_m.data, testing::ElementsAre(0.0f, 1.234f, 1.235f, 0.0f));
  EXPECT_TRUE(read.rgb.empty());
}

TEST(ReferencePose, MayLackVelocities) {
  ScratchDirectory scratch;
  DatasetInfo info = SampleInfo();
  info.simulated = false;
  DatasetWriter writer(scratch.path() / "run", info, {});
  const ChannelId pose = writer.AddChannel(PoseChannel("truth/digger/pose.csv", false));
  writer.Write(pose, RowOf(SamplePose(4), /*with_velocity=*/false));
  writer.Finish();
  const Recording recording(scratch.path() / "run");
  EXPECT_FALSE(recording.info().simulated);
  const PoseRecording read = recording.LoadPose("truth/digger/pose.csv");
  EXPECT_FALSE(read.has_velocity);
  EXPECT_TRUE(read.poses.at(0).X_WB.isApprox(SamplePose(4).X_WB, 1e-14));
}

TEST(Recording, SensorsOfAFormAreThoseOfKindsThatOnlyTheirOwnFilesNameToo) {
  ScratchDirectory scratch;
  DatasetWriter writer(scratch.path() / "run", SampleInfo(), {});
  const ChannelInfo radar = {"m/radar", "radar", ChannelForm::kScans, "type: radar\n", {}};
  const ChannelInfo time_of_flight = {"m/tof", "tof", ChannelForm::kPictures, "type: tof\n", {}};
  const ChannelInfo tilt = {"m/tilt", "tilt", ChannelForm::kRows, "type: tilt\n", {"tilt_rad"}};
  const ChannelId scans = writer.AddChannel(radar), pictures = writer.AddChannel(time_of_flight);
  writer.AddChannel(tilt);
  writer.AddChannel(LidarChannel("m/lidar", "type: lidar\n"));
  writer.AddChannel(GnssChannel("m/gnss", "type: gnss\n"));
  writer.AddChannel(ImuChannel("m/imu", "type: imu\n"));
  writer.AddChannel(TableChannel("m/commands.csv", {"boom"}));
  writer.Write(scans, SampleScan(0));
  writer.Write(pictures, SampleFrame(0));
  writer.Finish();
  const Recording recording(scratch.path() / "run");
  using testing::ElementsAre;
  EXPECT_THAT(recording.SensorsOf(ChannelForm::kScans), ElementsAre("m/lidar", "m/radar"));
  EXPECT_THAT(recording.SensorsOf(ChannelForm::kPictures), ElementsAre("m/tof"));
  EXPECT_THAT(recording.SensorsOf(ChannelForm::kRows), ElementsAre("m/imu", "m/gnss", "m/tilt"));
  EXPECT_THAT(recording.SeriesChannels(), ElementsAre("m/imu", "m/tilt"));
  EXPECT_EQ(recording.TypeOf("m/radar"), "radar");
}

}  // namespace
}  // namespace tera
