#include "render/gl/studios.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "rasterizer_stage.h"

namespace tera {
namespace {

/// A box that moves along over ground on which something changes, picture by picture.
class PicturesOfABox : public testing::Test {
 protected:
  static constexpr int kPictures = 6;

  PicturesOfABox() {
    stage_.SetTerrain(Ground(120, 0.1, Waves));
    stage_.AddBox(MakePose(kTarget), Vec3(0.4, 0.4, 0.4), SemanticClass::kBoom);
    for (int k = 0; k < kPictures; ++k) {
      TerrainSurface& ground = grounds_.emplace_back(k == 0 ? stage_.terrain : grounds_.back());
      for (int i = 50; i < 60; ++i) ground.Set(i, 50 + k, {0.3f, {.looseness = 255}});
    }
  }

  CameraFrame Shoot(int k, Rasterizer* rasterizer) const {
    SceneState state = stage_.state;
    state.terrain = &grounds_[static_cast<std::size_t>(k)];
    state.X_WB[0].translation().x() += 0.1 * k;
    return rasterizer->Render(Pinhole(), LookAt(kEye, kTarget), state);
  }

  /// Of all pictures, ordered before the first is looked at.
  std::vector<CameraFrame> AllBy(Studios* studios) const {
    std::vector<std::future<CameraFrame>> ordered;
    for (int k = 0; k < kPictures; ++k) {
      ordered.push_back(
          studios->Take(static_cast<std::size_t>(k) % studios->count(),
                        [this, k](Rasterizer* rasterizer) { return Shoot(k, rasterizer); }));
    }
    std::vector<CameraFrame> frames;
    for (auto& picture : ordered) frames.push_back(picture.get());
    return frames;
  }

  void ExpectAsAlone(Studios* studios) const {
    const std::vector<CameraFrame> frames = AllBy(studios);
    Rasterizer alone(stage_.model, {});
    for (int k = 0; k < kPictures; ++k) {
      const CameraFrame one = Shoot(k, &alone);
      const CameraFrame& frame = frames[static_cast<std::size_t>(k)];
      EXPECT_EQ(frame.rgb.data, one.rgb.data) << k;
      EXPECT_EQ(frame.depth_m.data, one.depth_m.data) << k;
      EXPECT_EQ(frame.instance.data, one.instance.data) << k;
    }
  }

  Stage stage_;
  std::vector<TerrainSurface> grounds_;
};

TEST_F(PicturesOfABox, AreTheSameFromAnyNumberOfStudios) {
  for (const int beside : {0, 1, 3}) {
    SCOPED_TRACE(beside);
    Studios studios(stage_.model, {}, 2, beside);
    EXPECT_EQ(studios.count(), beside == 3 ? 3u : 1u);
    EXPECT_EQ(studios.work_beside(), beside > 0);
    ExpectAsAlone(&studios);
    EXPECT_GT(studios.busy_s(), 0);
  }
}

TEST_F(PicturesOfABox, ThatCannotBeTakenSayWhy) {
  for (const int beside : {0, 1}) {
    Studios studios(stage_.model, {}, 1, beside);
    auto picture = studios.Take(
        0, [](Rasterizer*) -> CameraFrame { throw std::runtime_error("the lens cap is on"); });
    EXPECT_THROW(picture.get(), std::runtime_error);
    EXPECT_EQ(studios.Take(0, [this](Rasterizer* r) { return Shoot(0, r); }).get().rgb.width_px,
              Pinhole().width_px);
  }
}

TEST_F(PicturesOfABox, ThatWereNotBegunAreNoneWhereStudiosClose) {
  std::future<CameraFrame> last;
  {
    Studios studios(stage_.model, {}, 1, 1);
    for (int k = 0; k < kPictures; ++k) {
      last = studios.Take(0, [this, k](Rasterizer* r) { return Shoot(k, r); });
    }
  }
  EXPECT_THROW(last.get(), std::future_error);
}

TEST_F(PicturesOfABox, OfOneCameraAfterAnotherGoFromStudioToStudio) {
  Studios studios(stage_.model, {}, 1, 2);
  EXPECT_EQ(studios.NextForACamera(), 0u);
  EXPECT_EQ(studios.NextForACamera(), 1u);
  EXPECT_EQ(studios.NextForACamera(), 0u);
}

// Software takes every core for one picture already.
TEST(StudiosThatFit, AreOneWhereNoGpuDraws) {
  EXPECT_EQ(Studios::FittingCount({}, 1), 1);
  const Rasterizer rasterizer(Stage().model, {});
  const int many = Studios::FittingCount({}, 64);
  EXPECT_EQ(many, rasterizer.info().is_software ? 1 : Studios::kMost);
}

}  // namespace
}  // namespace tera
