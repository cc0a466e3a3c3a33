#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/perceived_site.h"

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Json = nlohmann::json;

/// The site with a colour camera on the mast, looking at pile and rock.
class PicturedSite : public PerceivedSite {
 protected:
  PicturedSite() {
    const std::string site = kSite;
    const std::size_t from = site.find("        - {name: lidar"), to = site.find("obstacles:");
    Write("site.yaml",
          site.substr(0, from) +
              "        - {name: camera, preset: tera:config/sensors/rgb_640.yaml, link: mast,\n"
              "           xyz_m: [0, 0, 3], rpy_deg: [1, 22, -14], width_px: 240, height_px: 180,\n"
              "           labels: false, rate_hz: 1}\n" +
              site.substr(to));
  }
};

TEST_F(PicturedSite, ACameraThatSitsAskewIsNamedAndItsOverlayLeavesNothing) {
  Record(
      {"--set", "effects.mast1.camera.extrinsic={roll_deg: 0.6, pitch_deg: -0.5, yaw_deg: 0.8}"});
  const Json json = Diagnosed();
  ASSERT_EQ(json["findings"].size(), 1u) << json;
  const Json& finding = json["findings"][0];
  EXPECT_EQ(finding["channel"], "mast1/camera");
  EXPECT_EQ(finding["mechanism"], "extrinsic");
  EXPECT_EQ(finding["held_out"]["unit"], "px");
  EXPECT_NEAR(finding["parameters"]["roll_deg"]["value"].get<double>(), 0.6, 0.05);
  EXPECT_NEAR(finding["parameters"]["pitch_deg"]["value"].get<double>(), -0.5, 0.05);
  EXPECT_NEAR(finding["parameters"]["yaw_deg"]["value"].get<double>(), 0.8, 0.05);
  EXPECT_NEAR(finding["parameters"]["z_m"]["value"].get<double>(), 0, 0.01);
  const Outcome again =
      Run({"diagnose", "site.yaml", "real", "--effects", "why/effects.yaml", "--out", "nothing"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, AllOf(HasSubstr("Camera: nothing found"), HasSubstr("clock offset")));
}

TEST_F(PicturedSite, AsDescribedGivesNoFinding) {
  Record();
  const Json json = Diagnosed();
  EXPECT_TRUE(json["findings"].empty()) << json;
  EXPECT_TRUE(json["not_judged"].empty()) << json;
  EXPECT_EQ(json["verdict"][0], "none");
}

TEST_F(PicturedSite, ACameraInTheDarkIsNotJudgedAndToldWhy) {
  Record({"--set", "environment.exposure_ev100=23"});
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("not judged"), HasSubstr("no contrast")));
  EXPECT_EQ(Json::parse(Read("why/diagnosis.json"))["not_judged"][0], "mast1/camera");
}

TEST_F(PicturedSite, ACameraOfAnotherSizeIsNotJudgedAndToldWhy) {
  Record();
  Write("site.yaml", Edited(Read("site.yaml"), "width_px: 240", "width_px: 200"));
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("not judged"), HasSubstr("240 x 180"), HasSubstr("has 200 x 180")));
}

TEST_F(PicturedSite, ACameraOfAFewLinesIsNotJudgedAndToldWhy) {
  Write("site.yaml", Edited(Read("site.yaml"), "height_px: 180", "height_px: 1"));
  Record();
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("not judged"), HasSubstr("240 x 1 pixels; need 32")));
}

TEST_F(PicturedSite, ATruncatedPictureIsOneErrorAndNoReport) {
  Record();
  const std::filesystem::path picture = scratch_.path() / "real/mast1/camera/rgb/0.png";
  std::filesystem::resize_file(picture, std::filesystem::file_size(picture) / 2);
  const Outcome outcome = Run({"diagnose", "site.yaml", "real", "--out", "why"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("0.png"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "why"));
}

}  // namespace
}  // namespace tera
