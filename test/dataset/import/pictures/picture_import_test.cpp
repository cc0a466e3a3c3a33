#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "core/faults.h"
#include "dataset/format/recording.h"
#include "dataset/format/sample_recording.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/import/bag_bytes.h"
#include "dataset/import/import_csv.h"
#include "dataset/lint/lint.h"

// Pictures of bags and folders, by hand. OpenCV writes the files.

namespace tera {
namespace {

using enum FaultKind;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kInfoType = "sensor_msgs/msg/CameraInfo";
constexpr int kWidth = 8, kHeight = 4;

/// sensor_msgs/Image with rows of `step` bytes.
Cdr ImageOf(std::int32_t seconds, const std::string& encoding, std::uint32_t step,
            const std::string& data, bool is_big_endian = false) {
  Cdr message;
  message.Header(seconds, 0).Add(std::uint32_t{kHeight}).Add(std::uint32_t{kWidth});
  message.Text(encoding).Add(std::uint8_t{is_big_endian}).Add(step);
  message.Add(static_cast<std::uint32_t>(data.size()));
  for (const char byte : data) message.Add(byte);
  return message;
}

Cdr FileMessage(std::int32_t seconds, const std::string& format, const std::string& data) {
  Cdr message;
  message.Header(seconds, 0).Text(format).Add(static_cast<std::uint32_t>(data.size()));
  for (const char byte : data) message.Add(byte);
  return message;
}

/// sensor_msgs/CameraInfo of fx 500, fy 510, centre (4.5, 2.5); P has half of these.
Cdr InfoOf(const std::string& model, const std::vector<double>& d, std::uint32_t width = kWidth,
           double fx = 500, std::uint32_t binning = 0) {
  Cdr message;
  message.Header(100, 0).Add(std::uint32_t{kHeight}).Add(width).Text(model).Sequence(d);
  message.Numbers({fx, 0, 4.5, 0, 510, 2.5, 0, 0, 1}).Numbers({1, 0, 0, 0, 1, 0, 0, 0, 1});
  message.Numbers({250, 0, 2.25, 0, 0, 255, 1.25, 0, 0, 0, 1, 0});
  message.Add(binning).Add(binning);
  for (int k = 0; k < 4; ++k) message.Add(std::uint32_t{0});
  return message.Add(std::uint8_t{0});
}

/// `bytes` once for each pixel.
std::string Pixels(const std::string& bytes, int count = kWidth * kHeight) {
  std::string all;
  for (int k = 0; k < count; ++k) all += bytes;
  return all;
}

std::string EncodedAs(const char* ending, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

class PictureImport : public testing::Test {
 protected:
  void File(const std::string& name, const std::string& bytes) {
    WriteWholeFile(scratch_.path() / name, bytes);
  }
  void Bag(const std::vector<Cdr>& pictures, const Cdr& info, const std::string& topic = "/cam/raw",
           const std::string& type = "sensor_msgs/msg/Image") {
    TopicsMcap bag;
    bag.Message("/cam/camera_info", kInfoType, 7, info);
    std::int64_t log_ns = 8;
    for (const Cdr& picture : pictures) bag.Message(topic, type, log_ns++, picture);
    File("log.mcap", bag.bytes());
  }
  ImportReport Import(const std::string& camera, const ImportOptions& options = {}) {
    File("mapping.yaml",
         "name: logged\nmachine: digger\nzero: start\ncameras: [{name: front, " + camera + "}]\n");
    std::filesystem::remove_all(Out());
    return ImportCsv(scratch_.path() / "mapping.yaml", Out(), options);
  }
  void ExpectFault(const std::string& camera, FaultKind kind, const std::string& place) {
    EXPECT_THAT([&] { Import(camera); }, ThrowsFault(kind, place)) << camera;
    EXPECT_FALSE(std::filesystem::exists(Out()));
    EXPECT_FALSE(std::filesystem::exists(Out().string() + ".incomplete"));
  }
  std::vector<CameraFrame> Frames() const {
    const Recording recording(Out());
    std::vector<CameraFrame> frames;
    for (const TimeNs t_ns : recording.FrameTimes("digger/front")) {
      frames.push_back(recording.LoadFrame("digger/front", t_ns));
    }
    return frames;
  }
  CameraLens Lens() const { return ReadSensorSheet(Out() / "digger/front").lens.value(); }
  std::filesystem::path Out() const { return scratch_.path() / "out"; }

  ScratchDirectory scratch_;
  static constexpr const char* kTopic = "file: log.mcap, topic: /cam/raw, info: /cam/camera_info";
  static constexpr const char* kLens =
      "lens: {width_px: 8, height_px: 4, fx_px: 500, fy_px: 500, cx_px: 3.5, cy_px: 1.5}";
};

std::array<int, 3> ColourAt(const CameraFrame& frame, int x, int y) {
  return {frame.rgb.at(x, y, 0), frame.rgb.at(x, y, 1), frame.rgb.at(x, y, 2)};
}

TEST_F(PictureImport, EveryEncodingShowsTheSameColour) {
  struct Case {
    const char* encoding;
    std::uint32_t pixel_bytes;
    std::string data;
  };
  const auto bayer = [](const char* even, const char* odd) {
    std::string data;
    for (int row = 0; row < kHeight; ++row) data += Pixels(row % 2 == 0 ? even : odd, kWidth / 2);
    return data;
  };
  const std::vector<Case> cases = {{"rgb8", 3, Pixels("\xc8\x64\x32")},
                                   {"bgr8", 3, Pixels("\x32\x64\xc8")},
                                   {"rgba8", 4, Pixels("\xc8\x64\x32\xff")},
                                   {"bgra8", 4, Pixels("\x32\x64\xc8\xff")},
                                   {"bayer_rggb8", 1, bayer("\xc8\x64", "\x64\x32")},
                                   {"bayer_bggr8", 1, bayer("\x32\x64", "\x64\xc8")},
                                   {"bayer_grbg8", 1, bayer("\x64\xc8", "\x32\x64")},
                                   {"bayer_gbrg8", 1, bayer("\x64\x32", "\xc8\x64")}};
  for (const Case& one : cases) {
    Bag({ImageOf(100, one.encoding, one.pixel_bytes * kWidth, one.data)}, InfoOf("plumb_bob", {}));
    Import(kTopic);
    const std::vector<CameraFrame> frames = Frames();
    ASSERT_EQ(frames.size(), 1u) << one.encoding;
    EXPECT_EQ(ColourAt(frames[0], 3, 2), (std::array{200, 100, 50})) << one.encoding;
    EXPECT_TRUE(frames[0].depth_m.empty());
  }
  // Red of ITU-R BT.601 is Y 81, U 90, V 240, within rounding.
  for (const auto& [encoding, data] :
       {std::pair{"uyvy", "\x5a\x51\xf0\x51"}, std::pair{"yuv422_yuy2", "\x51\x5a\x51\xf0"}}) {
    Bag({ImageOf(100, encoding, 2 * kWidth, Pixels(data, kWidth * kHeight / 2))},
        InfoOf("plumb_bob", {}));
    Import(kTopic);
    const auto colour = ColourAt(Frames().at(0), 3, 2);
    EXPECT_NEAR(colour[0], 255, 2) << encoding;
    EXPECT_NEAR(colour[1], 0, 2) << encoding;
    EXPECT_NEAR(colour[2], 0, 2) << encoding;
  }
}

TEST_F(PictureImport, DepthIsInMetresAndZeroWhereNothingWasMeasured) {
  std::string floats;
  for (int k = 0; k < kWidth * kHeight; ++k) {
    const float z_m = k == 5   ? std::nanf("")
                      : k == 6 ? std::numeric_limits<float>::infinity()
                               : 2.5F;
    floats.append(reinterpret_cast<const char*>(&z_m), sizeof z_m);
  }
  Bag({ImageOf(100, "32FC1", 4 * kWidth, floats)}, InfoOf("plumb_bob", {}));
  Import(kTopic);
  EXPECT_NEAR(Frames().at(0).depth_m.at(0, 0), 2.5, 1e-6);
  EXPECT_EQ(Frames().at(0).depth_m.at(5, 0), 0);
  EXPECT_EQ(Frames().at(0).depth_m.at(6, 0), 0);
  EXPECT_TRUE(Frames().at(0).rgb.empty());
  // 1234 mm is 0x04d2.
  Bag({ImageOf(100, "16UC1", 2 * kWidth, Pixels("\xd2\x04"))}, InfoOf("plumb_bob", {}));
  Import(kTopic);
  EXPECT_NEAR(Frames().at(0).depth_m.at(7, 3), 1.234, 1e-6);
  Bag({ImageOf(100, "16UC1", 2 * kWidth, Pixels("\x04\xd2"), true)}, InfoOf("plumb_bob", {}));
  Import(kTopic);
  EXPECT_NEAR(Frames().at(0).depth_m.at(7, 3), 1.234, 1e-6);
}

TEST_F(PictureImport, RowsMayBePadded) {
  std::string data;
  for (int row = 0; row < kHeight; ++row) {
    data += Pixels(std::string(1, static_cast<char>(10 * row + 10)), kWidth) + "pad";
  }
  Bag({ImageOf(100, "mono8", kWidth + 3, data)}, InfoOf("plumb_bob", {}));
  Import(kTopic);
  EXPECT_EQ(ColourAt(Frames().at(0), 0, 3), (std::array{40, 40, 40}));
}

TEST_F(PictureImport, LensIsThatOfCameraInfo) {
  const std::vector<Cdr> one = {ImageOf(100, "mono8", kWidth, Pixels("a"))};
  Bag(one, InfoOf("plumb_bob", {0.1, -0.2, 0.003, 0.004, 0.05}));
  Import(kTopic);
  const CameraLens brown = Lens();
  EXPECT_EQ(brown.law, "brown_conrady");
  EXPECT_EQ(brown.fx_px, 500);
  EXPECT_EQ(brown.fy_px, 510);
  EXPECT_EQ(brown.cx_px, 4.5);
  EXPECT_EQ(brown.cy_px, 2.5);
  EXPECT_EQ(brown.k2, -0.2);
  EXPECT_EQ(brown.p1, 0.003);
  EXPECT_EQ(brown.p2, 0.004);
  EXPECT_EQ(brown.k3, 0.05);
  Bag(one, InfoOf("rational_polynomial", {1, 2, 3, 4, 5, 6, 7, 8}));
  Import(kTopic);
  EXPECT_EQ(Lens().law, "rational");
  EXPECT_EQ(Lens().k6, 8);
  EXPECT_EQ(Lens().p1, 3);
  Bag(one, InfoOf("equidistant", {1, 2, 3, 4}));
  Import(kTopic);
  EXPECT_EQ(Lens().law, "kannala_brandt");
  EXPECT_EQ(Lens().k4, 4);
  Import(std::string(kTopic) + ", rectified: true");
  EXPECT_EQ(Lens().law, "brown_conrady");
  EXPECT_EQ(Lens().fx_px, 250);
  EXPECT_EQ(Lens().cy_px, 1.25);
  EXPECT_EQ(Lens().k1, 0);
}

TEST_F(PictureImport, CameraInfoThatCannotBeTheLensIsRefused) {
  const std::vector<Cdr> one = {ImageOf(100, "mono8", kWidth, Pixels("a"))};
  Bag(one, InfoOf("thin_prism", {1, 2, 3}));
  ExpectFault(kTopic, kUnsupported, "info");
  Bag(one, InfoOf("plumb_bob", {}, kWidth, 0));
  ExpectFault(kTopic, kOutOfRange, "info");
  Bag(one, InfoOf("plumb_bob", {}, kWidth, 500, 2));
  ExpectFault(kTopic, kUnsupported, "info");
  Bag(one, InfoOf("plumb_bob", {}, kWidth + 1));
  ExpectFault(kTopic, kInconsistent, "log.mcap: /cam/raw message 1");
  Cdr cut;
  cut.Header(100, 0).Add(std::uint32_t{kHeight});
  Bag(one, cut);
  ExpectFault(kTopic, kMalformed, "info");
  // By the name, it may be that of rectified pictures.
  Bag(one, InfoOf("plumb_bob", {}), "/cam/image_rect");
  const std::string rect = "file: log.mcap, topic: /cam/image_rect, info: /cam/camera_info";
  ExpectFault(rect, kMissing, "rectified");
  Import(rect + ", rectified: true");
  EXPECT_EQ(Lens().fx_px, 250);
}

TEST_F(PictureImport, PicturesWithoutCameraInfoAreRefusedUnlessTheMappingHasTheLensOrSaysSo) {
  Bag({ImageOf(100, "mono8", kWidth, Pixels("a"))}, InfoOf("plumb_bob", {}));
  const std::string topic = "file: log.mcap, topic: /cam/raw";
  ExpectFault(topic, kMissing, "info");
  ExpectFault(topic + ", info: /cam/camera_inf", kNoSuchName, "info");
  ExpectFault(topic + ", info: /cam/raw", kUnsupported, "info");
  ExpectFault(std::string(kTopic) + ", uncalibrated: true", kInconsistent, "cameras[0]");
  Import(topic + ", " + kLens);
  EXPECT_EQ(Lens().cx_px, 3.5);
  const ImportReport report = Import(topic + ", uncalibrated: true");
  EXPECT_FALSE(ReadSensorSheet(Out() / "digger/front").lens);
  EXPECT_THAT(report.channels[0].remarks, Contains(HasSubstr("without a lens")));
}

TEST_F(PictureImport, CompressedPicturesAreThoseOfTheirFiles) {
  const cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar(50, 100, 200));  // BGR
  const cv::Mat depth(kHeight, kWidth, CV_16UC1, cv::Scalar(1234));
  struct Case {
    std::string bytes;
    bool is_depth;
  };
  for (const Case& one :
       {Case{EncodedAs(".png", picture), false}, Case{EncodedAs(".jpg", picture), false},
        Case{EncodedAs(".png", depth), true}}) {
    Bag({FileMessage(100, "as the bytes say", one.bytes)}, InfoOf("plumb_bob", {}), "/cam/raw",
        "sensor_msgs/msg/CompressedImage");
    Import(kTopic);
    const CameraFrame frame = Frames().at(0);
    EXPECT_EQ(frame.rgb.empty(), one.is_depth);
    if (one.is_depth) {
      EXPECT_NEAR(frame.depth_m.at(1, 1), 1.234, 1e-6);
    } else {
      EXPECT_NEAR(frame.rgb.at(1, 1, 0), 200, 2);
      EXPECT_NEAR(frame.rgb.at(1, 1, 2), 50, 2);
    }
    // Without its last bytes.
    Bag({FileMessage(100, "", one.bytes.substr(0, one.bytes.size() - 12))}, InfoOf("plumb_bob", {}),
        "/cam/raw", "sensor_msgs/msg/CompressedImage");
    ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  }
  // A whole picture's marker stands before the end, as that of a thumbnail does.
  const std::string jpeg = EncodedAs(".jpg", picture);
  Bag({FileMessage(100, "", jpeg + jpeg.substr(0, jpeg.size() / 2))}, InfoOf("plumb_bob", {}),
      "/cam/raw", "sensor_msgs/msg/CompressedImage");
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  Bag({FileMessage(100, "", jpeg + std::string(5, '\0'))}, InfoOf("plumb_bob", {}), "/cam/raw",
      "sensor_msgs/msg/CompressedImage");
  Import(kTopic);
  Bag({FileMessage(100, "webp", "RIFFxxxxWEBP")}, InfoOf("plumb_bob", {}), "/cam/raw",
      "sensor_msgs/msg/CompressedImage");
  ExpectFault(kTopic, kUnsupported, "log.mcap: /cam/raw message 1");
  Bag({FileMessage(100, "16UC1; compressedDepth png", "x")}, InfoOf("plumb_bob", {}), "/cam/raw",
      "sensor_msgs/msg/CompressedImage");
  ExpectFault(kTopic, kUnsupported, "log.mcap: /cam/raw message 1");
}

TEST_F(PictureImport, StampsThatGoBackAreToldAndCanBeLeftOut) {
  const auto at = [](std::int32_t seconds) {
    return ImageOf(seconds, "mono8", kWidth, Pixels("a"));
  };
  Bag({at(100), at(101), at(99), at(102)}, InfoOf("plumb_bob", {}));
  ExpectFault(kTopic, kInconsistent, "log.mcap: /cam/raw message 3");
  const ImportReport report = Import(kTopic, {.skips_bad_rows = true});
  EXPECT_EQ(report.channels[0].left_out, 1);
  EXPECT_EQ(Frames().size(), 3u);
  EXPECT_EQ(Frames()[2].t_ns, 2 * kNsPerSecond);
  EXPECT_EQ(ReadSensorSheet(Out() / "digger/front").rate_hz, 1);
  // The recorder's clock went on.
  Import(std::string(kTopic) + ", time: {column: log_time}");
  EXPECT_EQ(Frames().size(), 4u);
}

TEST_F(PictureImport, MessagesThatAreNoPicturesAreTold) {
  const Cdr info = InfoOf("plumb_bob", {});
  Bag({ImageOf(100, "mono16", 2 * kWidth, Pixels("ab"))}, info);
  ExpectFault(kTopic, kUnsupported, "log.mcap: /cam/raw message 1");
  Bag({ImageOf(100, "rgb8", 3 * kWidth, Pixels("abc", 5))}, info);
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  Bag({ImageOf(100, "rgb8", kWidth, Pixels("abc"))}, info);  // rows shorter than their pixels
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  // Rows that end within a pixel's 16 bits.
  Bag({ImageOf(100, "16UC1", 2 * kWidth + 1, Pixels("ab", kWidth * kHeight + 2))}, info);
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  Bag({ImageOf(100, "mono8", 0, "")}, info);
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  Cdr cut;
  Bag({cut.Header(100, 0).Add(std::uint32_t{9})}, info);
  ExpectFault(kTopic, kMalformed, "log.mcap: /cam/raw message 1");
  Bag({ImageOf(100, "mono8", kWidth, Pixels("a")), ImageOf(101, "16UC1", 2 * kWidth, Pixels("ab"))},
      info);
  ExpectFault(kTopic, kInconsistent, "log.mcap: /cam/raw message 2");
  Bag({Cdr()}, info, "/cam/raw", "std_msgs/msg/String");
  ExpectFault(kTopic, kUnsupported, "topic");
  ExpectFault("file: log.mcap, info: /cam/camera_info", kMissing, "topic");
  File("table.csv", "t,a\n0,1\n");
  ExpectFault("file: table.csv, topic: /cam/raw, info: /i", kUnsupported, "file");
}

// --- Folders.

TEST_F(PictureImport, FolderOfPicturesComesInByItsNamesOrItsTimes) {
  MakeFolder(scratch_.path() / "pictures");
  const cv::Mat red(kHeight, kWidth, CV_8UC3, cv::Scalar(0, 0, 255));
  const cv::Mat grey(kHeight, kWidth, CV_8UC1, cv::Scalar(77));
  File("pictures/1700000000000000000.png", EncodedAs(".png", red));
  File("pictures/1700000000100000000.PNG", EncodedAs(".png", grey));
  File("pictures/notes.txt", "no picture");
  const std::string folder = std::string("files: pictures, ") + kLens;
  Import(folder);
  ASSERT_EQ(Frames().size(), 2u);
  EXPECT_EQ(ColourAt(Frames()[0], 0, 0), (std::array{255, 0, 0}));
  EXPECT_EQ(ColourAt(Frames()[1], 7, 3), (std::array{77, 77, 77}));
  EXPECT_EQ(Frames()[1].t_ns, 100'000'000);
  File("times.txt", "5.0\n5.5\n");
  Import(folder + ", times: times.txt");
  EXPECT_EQ(Frames()[1].t_ns, 500'000'000);
  File("times.txt", "5.0\n4.5\n");
  ExpectFault(folder + ", times: times.txt", kInconsistent, "1700000000100000000.PNG");
  File("times.txt", "5.0\n");
  ExpectFault(folder + ", times: times.txt", kInconsistent, "times");
  ExpectFault("files: pictures", kMissing, "lens");
  File("pictures/a.png", EncodedAs(".png", red));
  ExpectFault(folder, kMissing, "times");
  MakeFolder(scratch_.path() / "none");
  ExpectFault(std::string("files: none, ") + kLens, kMissing, "files");
  File("none/1700000000000000000.jpg", "");
  ExpectFault(std::string("files: none, ") + kLens, kUnsupported, "1700000000000000000.jpg");
}

TEST_F(PictureImport, LintFindsNoErrorInAnImportedCamera) {
  Bag({ImageOf(100, "mono8", kWidth, Pixels("a")), ImageOf(101, "mono8", kWidth, Pixels("b"))},
      InfoOf("equidistant", {0.1, 0, 0, 0}));
  Import(std::string(kTopic) + ", mount: {link: upper, xyz_m: [1, 0, 2]}");
  const LintReport report = Lint(Out(), {});
  EXPECT_EQ(report.CountOf(Severity::kError), 0);
}

}  // namespace
}  // namespace tera
