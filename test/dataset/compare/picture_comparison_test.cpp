#include "dataset/compare/picture_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "core/faults.h"
#include "dataset/compare/compare.h"
#include "dataset/compare/comparison_report.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

namespace fs = std::filesystem;
using enum FaultKind;
using testing::HasSubstr;

constexpr const char* kCamera = "type: camera\nname: front\nrate_hz: 10\n";

/// Grey noise of a mean and a deviation.
CameraFrame Noise(double mean_dn, double sigma_dn, int side_px = 128) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(mean_dn, sigma_dn);
  CameraFrame frame;
  frame.rgb = Image<std::uint8_t>(side_px, side_px, 3);
  for (std::size_t p = 0; p < frame.rgb.data.size(); p += 3) {
    const auto dn = static_cast<std::uint8_t>(std::clamp(std::lround(noise(random)), 0L, 255L));
    for (std::size_t c = 0; c < 3; ++c) frame.rgb.data[p + c] = dn;
  }
  return frame;
}

void WritePictures(const fs::path& directory, std::vector<CameraFrame> frames) {
  DatasetWriter writer(directory, SampleInfo(), {});
  const ChannelId camera = writer.AddChannel(CameraChannel("husky/front", kCamera));
  TimeNs t_ns = 0;
  for (CameraFrame& frame : frames) {
    frame.t_ns = frame.t_available_ns = t_ns;
    t_ns += kSamplePeriod_ns;
    writer.Write(camera, std::move(frame));
  }
  writer.Finish();
}

TEST(PictureComparison, ExposureAndNoiseOfBothSidesAreThoseOfThePictures) {
  ScratchDirectory scratch;
  WritePictures(scratch.path() / "real", {Noise(100, 4), Noise(100, 4)});
  WritePictures(scratch.path() / "sim", {Noise(110, 8), Noise(140, 8)});
  const Comparison all = Compare(scratch.path() / "real", scratch.path() / "sim");
  ASSERT_EQ(all.machines.at(0).pictures.size(), 1u);
  const PictureComparison& c = all.machines[0].pictures[0];
  ASSERT_TRUE(c.a && c.b && c.difference_dn);
  // 128^2 pixels of deviation 8: a mean within 5 standard errors, 0.32.
  EXPECT_NEAR(c.a->mean_dn, 100, 0.32);
  EXPECT_NEAR(c.b->mean_dn, 125, 0.32);
  EXPECT_EQ(c.a->bright, 0);
  // Rounding to whole numbers adds 1/12; the median of |I * L| is within some percent.
  EXPECT_NEAR(c.a->realism.surfaces.at(0).noise_dn, 4, 0.2);
  EXPECT_NEAR(c.b->realism.surfaces.at(0).noise_dn, 8, 0.4);
  // The noise of b is twice that of a, pixel by pixel: the second pair differs by 40 + noise of 4.
  ASSERT_EQ(c.worst.size(), 2u);
  EXPECT_EQ(c.worst[0].t.a_ns, kSamplePeriod_ns);
  EXPECT_NEAR(c.worst[0].difference, 40, 0.2);
  const auto json = nlohmann::json::parse(ComparisonJson(all));
  EXPECT_EQ(json["machines"][0]["pictures"][0]["reference"]["realism"]["pictures"], 2);
  EXPECT_THAT(ComparisonTable(all), HasSubstr("camera front: 2 pairs"));
  EXPECT_EQ(WriteWorstFrames(all, scratch.path() / "real", scratch.path() / "sim",
                             scratch.path() / "worst"),
            2);
}

TEST(PictureComparison, SaturatedPixelsAreCounted) {
  ScratchDirectory scratch;
  CameraFrame half = Noise(100, 4);
  std::fill(half.rgb.data.begin(), half.rgb.data.begin() + 3 * 128 * 64, std::uint8_t{255});
  WritePictures(scratch.path() / "real", {Noise(100, 4)});
  WritePictures(scratch.path() / "sim", {half});
  const Comparison all = Compare(scratch.path() / "real", scratch.path() / "sim");
  EXPECT_EQ(all.machines.at(0).pictures.at(0).b->bright, 0.5);
  EXPECT_EQ(all.machines.at(0).pictures.at(0).a->bright, 0);
}

TEST(PictureComparison, OtherSizesAreComparedByStatisticsAlone) {
  ScratchDirectory scratch;
  WritePictures(scratch.path() / "real", {Noise(100, 4)});
  WritePictures(scratch.path() / "sim", {Noise(100, 4, 96)});
  const Comparison all = Compare(scratch.path() / "real", scratch.path() / "sim");
  const PictureComparison& c = all.machines.at(0).pictures.at(0);
  EXPECT_FALSE(c.difference_dn);
  EXPECT_EQ(c.b->width_px, 96);
  EXPECT_THAT(PictureTable(c), HasSubstr("sizes differ"));
}

TEST(PictureComparison, PicturesTooSmallForASpectrumAreRefused) {
  ScratchDirectory scratch;
  WritePictures(scratch.path() / "real", {Noise(100, 4)});
  WritePictures(scratch.path() / "sim", {Noise(100, 4, 32)});
  EXPECT_THAT([&] { Compare(scratch.path() / "real", scratch.path() / "sim"); },
              ThrowsFault(kOutOfRange, "front"));
}

}  // namespace
}  // namespace tera
