#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/units.h"
#include "dataset/format/site_frame.h"
#include "render/gl/rasterizer_pool.h"
#include "render/hand_made_scene.h"
#include "sensors/camera/camera_on_a_link.h"
#include "sensors/sensor.h"

// Pictures taken concurrently with the run equal those taken at once.

namespace tera {
namespace {

const SampleClock kSteps{.rate_hz = 50};

/// A cube that passes over ground that rises step by step.
class WorkedScene : public SensedScene {
 public:
  WorkedScene(const SceneModel& model, int beside)
      : rasterizers_(std::make_unique<RasterizerPool>(model, EglOptions{}, 1, beside)) {}
  void Step(std::int64_t k) {
    k_ = k;
    for (int i = 0; i < 5; ++i) ground_.Set(10 + i, static_cast<int>(k % 40), {0.5f, {}});
  }

  const TerrainSurface& ground() const override { return ground_; }
  Shapes ShapesNow() const override { return {}; }
  std::vector<Pose> BodiesBetween(double s) const override {
    return {CubeAt(static_cast<double>(k_ - 1) + s)};
  }
  std::vector<Pose> BodiesAt(TimeNs t_ns) const override {
    return {CubeAt(ToSeconds(t_ns) * kSteps.rate_hz)};
  }
  KeptScene Keep() const override {
    if (!rasterizers_->work_beside()) return SensedScene::Keep();
    return {std::make_shared<const TerrainSurface>(ground_), {}, nullptr};
  }
  RasterizerPool* rasterizers() const override { return rasterizers_.get(); }
  RayScene* ray_scene() const override { return nullptr; }
  int threads() const override { return 1; }

 private:
  static Pose CubeAt(double steps) { return MakePose({4, 0.02 * steps - 1, 0.5}); }

  std::unique_ptr<RasterizerPool> rasterizers_;
  TerrainSurface ground_ = testing::Ground(81, 81, 0.25, -10, [](double, double) { return 0.0; });
  std::int64_t k_ = 0;
};

/// Keeps frames; it already has those at the times of every `has_every`-th.
class FrameShelf : public MeasurementSink {
 public:
  explicit FrameShelf(int has_every) : has_every_(has_every) {}
  ChannelId AddChannel(const ChannelInfo&) override { return 0; }
  void Write(ChannelId, Measurement measurement) override {
    frames.push_back(std::get<CameraFrame>(std::move(measurement)));
    times_ns.push_back(frames.back().t_ns);
  }
  bool NeedsFrame(ChannelId, TimeNs t_ns, TimeNs) const override {
    return has_every_ == 0 || t_ns / 100'000'000 % has_every_ != 0;
  }
  void MarkPresent(ChannelId, TimeNs t_ns) override { times_ns.push_back(t_ns); }

  std::vector<CameraFrame> frames;
  std::vector<TimeNs> times_ns;  ///< in the order of writing

 private:
  int has_every_;
};

class PicturesBesideARun : public ::testing::TestWithParam<std::string> {
 protected:
  /// Frames of a camera of 10 Hz over 0.8 s.
  FrameShelf Run(int beside, int has_every = 0) const {
    const CameraOnALink camera("width_px: 80, height_px: 60, fx_px: 60, " + GetParam());
    FrameShelf sink(has_every);
    const auto sampler = camera.SamplerInto(&sink);
    const SiteFrame site(46.78, -71.27, 90);
    WorkedScene scene(model_, beside);
    const auto state_at = [](std::int64_t k) {
      MachineState state;
      state.links.emplace_back();
      state.links.back().X_WB =
          MakePose({-2 + 0.01 * static_cast<double>(k), 0, 2}, 0, 20 * kDeg, 0);
      return state;
    };
    MachineState before = state_at(0);
    sampler->SampleStart({0, 0, before, before, site, scene});
    for (std::int64_t k = 1; k <= 40; ++k) {
      const MachineState after = state_at(k);
      scene.Step(k);
      sampler->Sample({kSteps.Due(k - 1), kSteps.Due(k), before, after, site, scene});
      before = after;
    }
    sampler->Finish({kSteps.Due(40), kSteps.Due(41), before, state_at(41), site, scene});
    return sink;
  }

  void ExpectSame(const FrameShelf& a, const FrameShelf& b) const {
    EXPECT_EQ(a.times_ns, b.times_ns);
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t k = 0; k < a.frames.size(); ++k) {
      SCOPED_TRACE(k);
      EXPECT_EQ(a.frames[k].t_available_ns, b.frames[k].t_available_ns);
      EXPECT_EQ(a.frames[k].rgb.data, b.frames[k].rgb.data);
      EXPECT_EQ(a.frames[k].depth_m.data, b.frames[k].depth_m.data);
      EXPECT_EQ(a.frames[k].instance.data, b.frames[k].instance.data);
      EXPECT_EQ(a.frames[k].flow_to_this.data, b.frames[k].flow_to_this.data);
    }
  }

  SceneModel model_ = testing::OneBodyEach({testing::CubeMesh(0.5)});
};

TEST_P(PicturesBesideARun, AreThoseThatAreTakenAtOnce) {
  const FrameShelf at_once = Run(0);
  ASSERT_GE(at_once.frames.size(), 8u);
  EXPECT_NE(at_once.frames[3].rgb.data, at_once.frames[7].rgb.data);
  ExpectSame(Run(1), at_once);
  ExpectSame(Run(3), at_once);
}

TEST_P(PicturesBesideARun, LeaveOutWhatIsThereAndKeepTheOrder) {
  const FrameShelf some = Run(3, 3);
  EXPECT_LT(some.frames.size(), some.times_ns.size());
  EXPECT_TRUE(std::is_sorted(some.times_ns.begin(), some.times_ns.end()));
  ExpectSame(some, Run(0, 3));
}

INSTANTIATE_TEST_SUITE_P(
    OfCameras, PicturesBesideARun,
    ::testing::Values("depth: true, depth_max_m: 20, disparity_noise_px: 0.1, rgb_noise: 3",
                      "labels: [instance, flow_to_this]",
                      "image_sensor: {exposure_s: 0.0002, shutter: {readout_s: 0.02}}"));

}  // namespace
}  // namespace tera
