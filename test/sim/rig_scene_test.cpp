#include "sim/rig_scene.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "core/config/config.h"
#include "sim/simulation.h"

namespace tera {
namespace {

class SceneOfARig : public testing::Test {
 protected:
  static Scenario Read() {
    const Config config = Config::FromText(
        "name: t\nduration_s: 1\nterrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}\n"
        "environment: {wind_mps: 3, dust: {}}\n"
        "machines: [{name: m, machine: tera:config/machines/tb235.yaml, operator: {type: idle}}]\n",
        "s.yaml");
    Scenario scenario = ReadScenario(config.root());
    config.Finish();
    return scenario;
  }
  void Open(int threads, bool late) {
    scene_.emplace(assembly_, threads);
    scene_->FollowAir(scenario_);
    scene_->OpenRasterizers(EglOptions{}, late);
  }
  /// A step that ends with this ground height at one place.
  void Step(float height_m) {
    ground_.Set(40, 40, {height_m, {}});
    simulation_.Step();
    const WorldStep step{simulation_.previous(), simulation_.state(), ground_};
    scene_->Advance(step);
  }

  Scenario scenario_ = Read();
  SceneAssembly assembly_{scenario_};
  Simulation simulation_{scenario_};
  TerrainSurface ground_ = simulation_.ground();
  std::optional<RigScene> scene_;
};

TEST_F(SceneOfARig, KeepsTheGroundForPicturesThatAreTakenBesideTheRun) {
  Open(2, true);
  Step(1);
  const KeptScene first = scene_->Keep();
  EXPECT_EQ(scene_->Keep().ground, first.ground) << "one copy for all cameras of a step";
  Step(2);
  const KeptScene second = scene_->Keep();
  Step(3);
  EXPECT_EQ(first.ground->height_m(40, 40), 1);
  EXPECT_EQ(second.ground->height_m(40, 40), 2);
  ASSERT_TRUE(first.dust);
  EXPECT_NE(first.dust.get(), scene_->air().dust);
}

TEST_F(SceneOfARig, LendsTheGroundItselfWherePicturesAreTakenAtOnce) {
  for (const auto& [threads, late] : {std::pair(1, true), std::pair(2, false)}) {
    Open(threads, late);
    Step(1);
    const KeptScene lent = scene_->Keep();
    EXPECT_EQ(lent.ground.get(), &ground_);
    EXPECT_EQ(lent.dust.get(), scene_->air().dust);
  }
}

}  // namespace
}  // namespace tera
