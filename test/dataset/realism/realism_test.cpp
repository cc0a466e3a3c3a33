#include "dataset/realism/realism.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/faults.h"
#include "dataset/format/sample_recording.h"

namespace tera {
namespace {

using enum FaultKind;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A recording of one camera: `frames` pictures of that size, left class 1, right class 2.
void WriteRecording(const std::filesystem::path& directory, int frames, int width, int height) {
  DatasetWriter writer(directory, SampleInfo(), {});
  const auto camera = writer.AddChannel(CameraChannel("m/camera", "type: camera\n"));
  std::mt19937 random(4);
  std::normal_distribution<double> normal(120, 6);
  for (int k = 0; k < frames; ++k) {
    CameraFrame frame;
    frame.t_ns = k * kSamplePeriod_ns;
    frame.rgb = Image<std::uint8_t>(width, height, 3);
    frame.semantic = Image<std::uint8_t>(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        frame.semantic.at(x, y) = x < width / 2 ? 1 : 2;
        const double dn = x < width / 2 ? normal(random) : 60;
        for (int c = 0; c < 3; ++c) frame.rgb.at(x, y, c) = static_cast<std::uint8_t>(dn);
      }
    }
    writer.Write(camera, frame);
  }
  writer.Finish();
}

TEST(Realism, TellsClassesApartAndCountsPictures) {
  const ScratchDirectory scratch;
  const std::filesystem::path dataset = scratch.path() / "d";
  WriteRecording(dataset, 3, 128, 96);
  const Realism all = MeasureRealism(dataset, 1);
  EXPECT_EQ(all.pictures, 3);
  ASSERT_EQ(all.surfaces.size(), 3u);
  EXPECT_EQ(all.surfaces[0].name, "all");
  EXPECT_EQ(all.surfaces[1].name, "terrain");
  EXPECT_NEAR(all.surfaces[1].noise_dn, 6, 0.4);
  EXPECT_NEAR(all.surfaces[2].noise_dn, 0, 0.05);
  EXPECT_EQ(all.surfaces[1].pixels, 3 * 58 * 90);
  EXPECT_EQ(MeasureRealism(dataset, 2).pictures, 2);
  EXPECT_THAT(RealismTable(all),
              AllOf(HasSubstr("3 pictures"), HasSubstr("Tolhurst"), HasSubstr("terrain")));
  const auto json = nlohmann::json::parse(RealismJson(all));
  EXPECT_EQ(json["surfaces"][1]["class"], "terrain");
  EXPECT_DOUBLE_EQ(json["amplitude_slope"]["mean"], all.slope_mean);
}

TEST(Realism, RefusesClassesOfAnotherSizeThanTheirPicture) {
  const ScratchDirectory scratch;
  WriteRecording(scratch.path() / "d", 1, 128, 96);
  WriteRecording(scratch.path() / "other", 1, 96, 96);
  const std::string classes = "m/camera/semantic/0.png";
  std::filesystem::copy_file(scratch.path() / "other" / classes, scratch.path() / "d" / classes,
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT([&] { MeasureRealism(scratch.path() / "d", 1); },
              ThrowsFault(kInconsistent, "d/m/camera"));
}

TEST(Realism, RefusesWhatHasNoPicturesOrTooSmallOnes) {
  const ScratchDirectory scratch;
  WriteRecording(scratch.path() / "small", 1, 63, 80);
  EXPECT_THAT([&] { MeasureRealism(scratch.path() / "small", 1); }, ThrowsFault(kOutOfRange));
  WriteRecording(scratch.path() / "none", 0, 128, 96);
  EXPECT_THAT([&] { MeasureRealism(scratch.path() / "none", 1); }, ThrowsFault(kMissing));
  EXPECT_THAT([&] { MeasureRealism(scratch.path() / "absent", 1); },
              ThrowsFault(kUnreadable, "absent"));
  WriteRecording(scratch.path() / "cut", 1, 128, 96);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path() / "cut")) {
    if (entry.path().extension() == ".png" && entry.path().parent_path().filename() == "rgb") {
      std::ofstream(entry.path()) << "no picture";
    }
  }
  EXPECT_THROW(MeasureRealism(scratch.path() / "cut", 1), InputError);
}

}  // namespace
}  // namespace tera
