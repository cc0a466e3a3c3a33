#include "render/gl/rasterizer_pool.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "rasterizer_stage.h"

namespace tera {
namespace {

/// A moving box over changing ground, picture by picture.
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

  /// Requests all pictures before the first is examined.
  std::vector<CameraFrame> AllBy(RasterizerPool* rasterizers) const {
    std::vector<std::future<CameraFrame>> ordered;
    for (int k = 0; k < kPictures; ++k) {
      ordered.push_back(
          rasterizers->Take(static_cast<std::size_t>(k) % rasterizers->count(),
                            [this, k](Rasterizer* rasterizer) { return Shoot(k, rasterizer); }));
    }
    std::vector<CameraFrame> frames;
    for (auto& picture : ordered) frames.push_back(picture.get());
    return frames;
  }

  void ExpectAsAlone(RasterizerPool* rasterizers) const {
    const std::vector<CameraFrame> frames = AllBy(rasterizers);
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

TEST_F(PicturesOfABox, AreTheSameFromAnyNumberOfRasterizers) {
  for (const int beside : {0, 1, 3}) {
    SCOPED_TRACE(beside);
    RasterizerPool rasterizers(stage_.model, {}, 2, beside);
    EXPECT_EQ(rasterizers.count(), beside == 3 ? 3u : 1u);
    EXPECT_EQ(rasterizers.work_beside(), beside > 0);
    ExpectAsAlone(&rasterizers);
    EXPECT_GT(rasterizers.busy_s(), 0);
  }
}

TEST_F(PicturesOfABox, ThatCannotBeTakenSayWhy) {
  for (const int beside : {0, 1}) {
    RasterizerPool rasterizers(stage_.model, {}, 1, beside);
    auto picture = rasterizers.Take(
        0, [](Rasterizer*) -> CameraFrame { throw std::runtime_error("the lens cap is on"); });
    EXPECT_THROW(picture.get(), std::runtime_error);
    EXPECT_EQ(rasterizers.Take(0, [this](Rasterizer* r) { return Shoot(0, r); }).get().rgb.width_px,
              Pinhole().width_px);
  }
}

TEST_F(PicturesOfABox, ThatWereNotBegunAreNoneWhereThePoolCloses) {
  std::future<CameraFrame> last;
  {
    RasterizerPool rasterizers(stage_.model, {}, 1, 1);
    for (int k = 0; k < kPictures; ++k) {
      last = rasterizers.Take(0, [this, k](Rasterizer* r) { return Shoot(k, r); });
    }
  }
  EXPECT_THROW(last.get(), std::future_error);
}

TEST_F(PicturesOfABox, OfOneCameraAfterAnotherGoFromRasterizerToRasterizer) {
  RasterizerPool rasterizers(stage_.model, {}, 1, 2);
  EXPECT_EQ(rasterizers.NextForACamera(), 0u);
  EXPECT_EQ(rasterizers.NextForACamera(), 1u);
  EXPECT_EQ(rasterizers.NextForACamera(), 0u);
}

// Software rendering already uses every core for one picture.
TEST(RasterizersThatFit, AreOneWhereNoGpuDraws) {
  EXPECT_EQ(RasterizerPool::FittingCount({}, 1), 1);
  const Rasterizer rasterizer(Stage().model, {});
  const int many = RasterizerPool::FittingCount({}, 64);
  EXPECT_EQ(many, rasterizer.info().is_software ? 1 : RasterizerPool::kMost);
}

}  // namespace
}  // namespace tera
