#include "sensors/camera/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/error.h"
#include "core/units.h"
#include "dataset/format/site_frame.h"
#include "render/gl/rasterizer_pool.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera.h"
#include "sensors/camera/camera_on_a_link.h"
#include "sensors/sensor.h"

namespace tera {
namespace {

using testing::OneBodyEach;
using testing::WallMesh;

constexpr int kSweepWidth = 160, kSweepHeight = 121;
constexpr double kSweepFocal_px = 150, kSweepDistance_m = 6;

/// A dark square, 2 m wide, against the sky 6 m ahead of a camera that looks along +y of W. The
/// square moves to the camera's right, which is +x of W.
class SquareThatPasses : public ::testing::Test {
 protected:
  SquareThatPasses() : model_(OneBodyEach({WallMesh(1, 0.5)})), rasterizer_(model_, {}) {
    lens_ = {.width_px = kSweepWidth,
             .height_px = kSweepHeight,
             .fx_px = kSweepFocal_px,
             .fy_px = kSweepFocal_px,
             .cx_px = 79.5,
             .cy_px = 60};
  }

  /// The scene at time t from the picture's: a square at `square_mps`, a camera that turns to its
  /// left at `turn_radps`.
  SeenScene At(TimeNs t_ns, double square_mps, double turn_radps) const {
    const double t_s = ToSeconds(t_ns - kStamp_ns);
    SeenScene seen;
    const Pose X_WS = MakePose({1, 2, 40}, 0, 0, 90 * kDeg + turn_radps * t_s);
    seen.X_WC = X_WS * OpticalInSensor();
    seen.state.t_ns = t_ns;
    seen.state.X_WB = {MakePose({1 + square_mps * t_s, 2 + kSweepDistance_m, 40}, 0, 0, 90 * kDeg)};
    return seen;
  }

  CameraFrame Shoot(const ShutterModel& shutter, double exposure_s, double square_mps,
                    double turn_radps) {
    const SceneAt scene_at = [&](TimeNs t_ns) { return At(t_ns, square_mps, turn_radps); };
    luminance_ = {.white_cdpm2 = 2e4};
    return Sweep({shutter, exposure_s, lens_, UsualLabels(), scene_at}, kStamp_ns, &rasterizer_,
                 &luminance_);
  }

  /// The first pixel of a row that shows the square.
  static int LeftEdge(const CameraFrame& frame, int row) {
    for (int x = 0; x < kSweepWidth; ++x) {
      if (frame.instance.at(x, row) == 1) return x;
    }
    return -1;
  }

  /// Where the luminance of a row crosses the share `level` of the way from the sky's to the
  /// square's, from the left, in pixels.
  double Crossing(int row, double level) const {
    const Image<float>& light = luminance_.cdpm2;
    const double sky = light.at(30, row, 1), square = light.at(79, row, 1);
    for (int x = 31; x < 79; ++x) {
      const double before = (light.at(x - 1, row, 1) - sky) / (square - sky);
      const double here = (light.at(x, row, 1) - sky) / (square - sky);
      if (before < level && here >= level) return x - 1 + (level - before) / (here - before);
    }
    return -1;
  }

  static constexpr TimeNs kStamp_ns = 400'000'000;
  SceneModel model_;
  Rasterizer rasterizer_;
  CameraIntrinsics lens_;
  LuminancePicture luminance_;
};

// The square passes at f v / z = 100 px/s. Over a readout of 0.12 s each row is 0.1 px ahead of the
// row above it, 12 px in all. Steps are 1 px, so that a row may be half a pixel off.
TEST_F(SquareThatPasses, ItsUprightEdgeIsSkewedByItsSpeedTimesTheTimeOfTheRows) {
  const CameraFrame frame = Shoot({.readout_s = 0.12, .motion_blur = false}, 0.001, 4.0, 0);
  const double left_px = 79.5 - kSweepFocal_px / kSweepDistance_m;
  for (int row = 40; row <= 80; ++row) {
    const double expected_px = left_px + 100 * 0.12 * (row - 60) / 120.0;
    EXPECT_NEAR(LeftEdge(frame, row) - 0.5, expected_px, 0.5 + 0.5) << row;
    EXPECT_NEAR(Crossing(row, 0.5), expected_px, 0.5 + 0.6) << row;
  }
  // Over many rows steps average out: the slope follows the rate.
  const double slope = (Crossing(80, 0.5) - Crossing(40, 0.5)) / 40;
  EXPECT_NEAR(slope, 0.1, 1.0 / 40);
}

// To a camera that turns left at w, static objects move right by f tan(w t) on the axis: 0.9 rad/s
// and 0.12 s are 16.2 px.
TEST_F(SquareThatPasses, ATurningCameraSkewsWhatStandsStill) {
  const CameraFrame frame =
      Shoot({.readout_s = 0.12, .motion_blur = false, .step_px = 0.5, .most_pictures = 101}, 0.001,
            0, 0.9);
  for (int row = 37; row <= 83; ++row) {
    const double turned_rad = 0.9 * 0.12 * (row - 60) / 120.0;
    const double expected_px =
        79.5 + kSweepFocal_px * std::tan(turned_rad - std::atan(1 / kSweepDistance_m));
    EXPECT_NEAR(LeftEdge(frame, row) - 0.5, expected_px, 0.25 + 0.5) << row;
  }
}

// An edge that passes at 100 px/s for 0.12 s is a ramp of 12 px. It takes 9.6 px from a tenth to
// nine tenths, about its position in the middle of the exposure.
TEST_F(SquareThatPasses, ItsEdgeIsBlurredOverItsSpeedTimesTheExposure) {
  const CameraFrame frame = Shoot({.readout_s = 0}, 0.12, 4.0, 0);
  for (const int row : {45, 60, 75}) {
    EXPECT_NEAR(Crossing(row, 0.9) - Crossing(row, 0.1), 9.6, 0.5) << row;
    EXPECT_NEAR(Crossing(row, 0.5), 79.5 - kSweepFocal_px / kSweepDistance_m, 0.6) << row;
    EXPECT_NEAR(LeftEdge(frame, row) - 0.5, 79.5 - kSweepFocal_px / kSweepDistance_m, 0.5) << row;
  }
}

TEST_F(SquareThatPasses, SkewAndBlurAddUp) {
  Shoot({.readout_s = 0.06, .step_px = 0.3, .most_pictures = 101}, 0.12, 4.0, 0);
  for (const int row : {78}) {  // below the horizon, where the background is even
    const double middle_px =
        79.5 - kSweepFocal_px / kSweepDistance_m + 100 * 0.06 * (row - 60) / 120.0;
    EXPECT_NEAR(Crossing(row, 0.5), middle_px, 0.6) << row;
    EXPECT_NEAR(Crossing(row, 0.9) - Crossing(row, 0.1), 9.6, 0.6) << row;
  }
}

TEST_F(SquareThatPasses, ABoxHoldsAllRowsOfWhatIsSkewed) {
  const CameraFrame frame = Shoot({.readout_s = 0.12, .motion_blur = false}, 0.001, 4.0, 0);
  ASSERT_EQ(frame.boxes.size(), 1u);
  EXPECT_EQ(frame.boxes[0].x_min_px, LeftEdge(frame, frame.boxes[0].y_min_px));
  EXPECT_GT(frame.boxes[0].visibility, 0.9);
  EXPECT_GT(frame.boxes[0].x_max_px - frame.boxes[0].x_min_px, 50 + 3);  // 50 px, and its skew
}

TEST_F(SquareThatPasses, WhereNothingMovesAPictureIsThatOfAnInstant) {
  const SeenScene still = At(kStamp_ns, 0, 0);
  LuminancePicture expected{.white_cdpm2 = 2e4};
  const CameraFrame instant =
      rasterizer_.Render(lens_, still.X_WC, still.state, UsualLabels(), &expected);
  const std::int64_t before = rasterizer_.triangles_drawn();
  rasterizer_.Render(lens_, still.X_WC, still.state, UsualLabels(), &expected);
  const std::int64_t of_one = rasterizer_.triangles_drawn() - before;
  const CameraFrame frame = Shoot({.readout_s = 0.1}, 0.1, 0, 0);
  EXPECT_EQ(rasterizer_.triangles_drawn() - before, 2 * of_one) << "more than one was drawn";
  EXPECT_EQ(luminance_.cdpm2.data, expected.cdpm2.data);
  EXPECT_EQ(frame.instance.data, instant.instance.data);
  EXPECT_EQ(frame.depth_m.data, instant.depth_m.data);
}

TEST_F(SquareThatPasses, EveryKeyOfAShutterChangesThePicture) {
  const auto measure = [&](const std::string& keys) {
    const Config config = Config::FromText(
        "sensor: {name: s, type: camera, link: b, rate_hz: 5, width_px: 160, height_px: 121, "
        "fx_px: 150, image_sensor: {exposure_s: 0.05, f_number: 16, transmission: 0.05, "
        "read_noise_e: 0, shutter: {" +
            keys + "}}}",
        "rig.yaml");
    const SensorDescription s = ReadSensor(config.root().Map("sensor"));
    config.Finish();
    return Camera(std::get<CameraModel>(s.model), s.clock, 0, 1, "m/s")
        .Measure(
            2, [&](TimeNs t_ns) { return At(t_ns, 4, 0); }, &rasterizer_);
  };
  const std::string plain = "readout_s: 0.1";
  const CameraFrame base = measure(plain);
  EXPECT_EQ(base.t_ns, kStamp_ns);
  EXPECT_EQ(base.t_available_ns, kStamp_ns + 75'000'000) << "half of readout and exposure later";
  EXPECT_EQ(measure(plain).rgb.data, base.rgb.data);
  for (const std::string keys :
       {"readout_s: 0.05", "readout_s: 0.1, motion_blur: false", "readout_s: 0.1, step_px: 4",
        "readout_s: 0.1, most_pictures: 3"}) {
    EXPECT_NE(measure(keys).rgb.data, base.rgb.data) << keys;
  }
}

/// Keeps the frames of one channel.
class FrameKeeper : public MeasurementSink {
 public:
  ChannelId AddChannel(const ChannelInfo&) override { return 0; }
  void Write(ChannelId, Measurement measurement) override {
    frames.push_back(std::get<CameraFrame>(std::move(measurement)));
  }
  bool NeedsFrame(ChannelId, TimeNs, TimeNs) const override { return true; }
  void MarkPresent(ChannelId, TimeNs) override {}

  std::vector<CameraFrame> frames;
};

/// A square that passes at 4 m/s, as the scene of a step.
class PassingScene : public SensedScene {
 public:
  explicit PassingScene(const SceneModel& model)
      : rasterizers_(std::make_unique<RasterizerPool>(model, EglOptions{}, 1, 0)) {}
  const TerrainSurface& ground() const override { return ground_; }
  Shapes ShapesNow() const override { return {}; }
  std::vector<Pose> BodiesBetween(double) const override {
    ADD_FAILURE() << "asked for the poses of the step alone";
    return {Pose::Identity()};
  }
  std::vector<Pose> BodiesAt(TimeNs t_ns) const override {
    return {MakePose({4 * ToSeconds(t_ns), kSweepDistance_m, 40}, 0, 0, 90 * kDeg)};
  }
  RasterizerPool* rasterizers() const override { return rasterizers_.get(); }
  RayScene* ray_scene() const override { return nullptr; }
  int threads() const override { return 1; }

 private:
  std::unique_ptr<RasterizerPool> rasterizers_;
  TerrainSurface ground_ = testing::Ground(11, 11, 1.0, -5, [](double, double) { return 0.0; });
};

// The link moves along +x of W at 1 m/s, and the square at 4 m/s: as a square that passes at 3 m/s.
TEST_F(SquareThatPasses, ASamplerTakesAPictureWhenItsLastRowIsComplete) {
  const CameraOnALink camera(
      "width_px: 160, height_px: 121, fx_px: 150, "
      "image_sensor: {exposure_s: 0.02, shutter: {readout_s: 0.06}}");
  FrameKeeper sink;
  const auto sampler = camera.SamplerInto(&sink);
  EXPECT_TRUE(sampler->LooksBack());
  const SiteFrame site(46.78, -71.27, 90);
  const PassingScene scene(model_);
  const SampleClock steps{.rate_hz = 200};
  const auto state_at = [&](std::int64_t k) {
    MachineState state;
    state.links.emplace_back();
    state.links.back().X_WB = MakePose({ToSeconds(steps.Due(k)), 0, 40}, 0, 0, 90 * kDeg);
    return state;
  };
  MachineState before = state_at(0);
  sampler->SampleStart({0, 0, before, before, site, scene});
  std::vector<TimeNs> taken_ns;
  for (std::int64_t k = 1; k <= 30; ++k) {
    const MachineState after = state_at(k);
    sampler->Sample({steps.Due(k - 1), steps.Due(k), before, after, site, scene});
    if (sink.frames.size() > taken_ns.size()) taken_ns.push_back(steps.Due(k));
    before = after;
  }
  ASSERT_EQ(taken_ns, (std::vector<TimeNs>{40'000'000, 140'000'000}));
  EXPECT_EQ(sampler->SceneNeededSince(150'000'000), 150'000'000) << "the next opens at 160 ms";
  const CameraFrame& frame = sink.frames.back();
  EXPECT_EQ(frame.t_ns, 100'000'000);
  EXPECT_EQ(frame.t_available_ns, 140'000'000);
  const double middle_px =
      79.5 + 75 * 0.1 - kSweepFocal_px / kSweepDistance_m;  // 3 m/s are 75 px/s
  for (int row = 45; row <= 75; ++row) {
    EXPECT_NEAR(LeftEdge(frame, row) - 0.5, middle_px + 75 * 0.06 * (row - 60) / 120.0, 1.0) << row;
  }
}

TEST(Shutter, ThatMakesNothingOfMotionIsRefused) {
  const Config config = Config::FromText(
      "sensor: {name: s, type: camera, link: b, rate_hz: 5, width_px: 16, "
      "height_px: 12, fx_px: 15, image_sensor: {shutter: {motion_blur: false}}}",
      "rig.yaml");
  ReadSensor(config.root().Map("sensor"));
  EXPECT_THROW(config.Finish(), InputError);
}

TEST(Shutter, WhoseReadoutIsLongerThanFromPictureToPictureIsRefused) {
  const Config config = Config::FromText(
      "sensor: {name: s, type: camera, link: b, rate_hz: 50, width_px: 16, "
      "height_px: 12, fx_px: 15, image_sensor: {shutter: {readout_s: 0.03}}}",
      "rig.yaml");
  ReadSensor(config.root().Map("sensor"));
  EXPECT_THROW(config.Finish(), InputError);
}

}  // namespace
}  // namespace tera
