#include "layout/study/cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "dataset/format/sample_recording.h"
#include "sim/run/generate.h"
#include "sim/state/state_log.h"

// A work cycle is the same whether simulated or played back from a dataset.

namespace tera {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr char kScene[] = R"(
name: scene
seed: 5
duration_s: 0.6
settle_s: 0.1
physics_rate_hz: 200
terrain: {size_m: [10, 10], cell_m: 0.1, soil: loose}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {yaw_deg: 20, joints_deg: {boom: 30, arm: -80, bucket: -60}}
    operator: {type: random_levers, amplitude: 0.8}
obstacles:
  - {name: stone1, label: rock, mesh: stone.glb, xy_m: [4, 1]}
)";

struct Moment {
  TimeNs t_ns;
  Eigen::Matrix4d bucket;
  double ground_m;
  bool operator==(const Moment& other) const {
    return t_ns == other.t_ns && bucket == other.bucket && ground_m == other.ground_m;
  }
};

class SceneCycle : public testing::Test {
 protected:
  SceneCycle() {
    WriteWholeFile(path() / "scene.yaml", kScene);
    fs::copy_file("assets/rock.glb", path() / "stone.glb");
  }
  const fs::path& path() const { return scratch_.path(); }
  fs::path Scene() const { return path() / "scene.yaml"; }
  fs::path Dataset(bool keep_state = true) const {
    const LoadedScenario loaded = LoadScenario(Scene(), {});
    Generate(loaded.scenario, loaded.resolved_yaml,
             {.out = path() / "base", .threads = 1, .keep_state = keep_state});
    return path() / "base";
  }
  static Moment Now(const Instant& now, const TerrainSurface& ground) {
    double sum_m = 0;
    for (int j = 0; j < ground.ny; ++j) {
      for (int i = 0; i < ground.nx; ++i) sum_m += (1 + i) * ground.height_m(i, j);
    }
    return {now.t_ns, now.machines.at(0).links.back().X_WB.matrix(), sum_m};
  }
  static std::vector<Moment> Steps(const Cycle& cycle) {
    std::vector<Moment> moments;
    cycle.ForEachStep([&](const Instant& now, const TerrainSurface& ground) {
      moments.push_back(Now(now, ground));
    });
    return moments;
  }
  static std::vector<double> Times_s(const Cycle& cycle, double rate_hz) {
    std::vector<double> times_s;
    cycle.ForEachMoment(rate_hz, [&](const Instant& now, const TerrainSurface&) {
      times_s.push_back(ToSeconds(now.t_ns));
    });
    return times_s;
  }

  const ScratchDirectory scratch_;
};

TEST_F(SceneCycle, OfADatasetIsThatOfItsScenario) {
  const auto simulated = Steps(Cycle(Scene(), {})), played = Steps(Cycle(Dataset(), {}));
  ASSERT_EQ(simulated.size(), 121u);  // 0.6 s at 200 Hz, and the start
  EXPECT_EQ(simulated.front().t_ns, 0);
  EXPECT_EQ(simulated.back().t_ns, FromSeconds(0.6));
  EXPECT_NE(simulated.front().ground_m, simulated.back().ground_m);
  EXPECT_TRUE(played == simulated);
}

TEST_F(SceneCycle, IsTheSameEveryTime) {
  const Cycle cycle(Dataset(), {});
  EXPECT_TRUE(Steps(cycle) == Steps(cycle));
}

TEST_F(SceneCycle, OfADatasetWhoseInputsHaveMovedIsTheSame) {
  const auto simulated = Steps(Cycle(Scene(), {}));
  const fs::path dataset = Dataset();
  const fs::path was = path() / "stone.glb", is = path() / "moved.glb";
  fs::rename(was, is);
  EXPECT_THAT([&] { Cycle(dataset, {}); }, ThrowsMessage<InputError>(HasSubstr("stone.glb")));
  EXPECT_TRUE(Steps(Cycle(dataset, {was.string() + "=" + is.string()})) == simulated);
}

TEST_F(SceneCycle, MomentsAreTheStepsNearestToMultiplesOfThePeriod) {
  const Cycle cycle(Scene(), {});
  EXPECT_THAT(Times_s(cycle, 5),
              testing::Pointwise(testing::DoubleNear(1e-9), {0.0, 0.2, 0.4, 0.6}));
  // Half of a step is 2.5 ms.
  for (const double rate_hz : {3.0, 7.0, 13.0, 33.0}) {
    const auto times_s = Times_s(cycle, rate_hz);
    ASSERT_EQ(times_s.size(), static_cast<std::size_t>(1 + std::floor((0.6 + 0.0025) * rate_hz)));
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      EXPECT_NEAR(times_s[k], static_cast<double>(k) / rate_hz, 0.0025 + 1e-9) << rate_hz;
    }
  }
}

TEST_F(SceneCycle, MoreMomentsThanStepsAreTheSteps) {
  EXPECT_EQ(Times_s(Cycle(Scene(), {}), 1000).size(), 121u);
}

TEST_F(SceneCycle, WithARigHasItsSensorsInEitherForm) {
  WriteWholeFile(path() / "rig.yaml",
                 "sensors: [{name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper}]\n");
  for (const fs::path& of : {Scene(), Dataset()}) {
    const Cycle cycle(of, {});
    EXPECT_TRUE(cycle.scenario().machines.at(0).sensors.empty());
    const Scenario with = cycle.WithRig(0, path() / "rig.yaml");
    ASSERT_EQ(with.machines.at(0).sensors.size(), 1u);
    EXPECT_EQ(with.machines[0].sensors[0].name, "lidar");
    EXPECT_THROW(cycle.WithRig(0, path() / "absent.yaml"), InputError);
  }
}

TEST_F(SceneCycle, WhatIsNoneIsRefused) {
  EXPECT_THAT([&] { Cycle(path() / "absent.yaml", {}); },
              ThrowsMessage<InputError>(HasSubstr("absent.yaml")));
  EXPECT_THAT([&] { Cycle(path(), {}); }, ThrowsMessage<InputError>(HasSubstr(path().string())));
  const fs::path dataset = Dataset(false);
  EXPECT_THAT([&] { Cycle(dataset, {}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("base"), HasSubstr("--keep-state"))));
}

TEST_F(SceneCycle, OfADamagedStateIsRefused) {
  const fs::path dataset = Dataset();
  const std::string good = ReadWholeFile(dataset / kStateFile);
  WriteWholeFile(dataset / kStateFile, std::string_view(good).substr(0, good.size() - 20));
  const Cycle cycle(dataset, {});
  EXPECT_THAT([&] { Steps(cycle); }, ThrowsMessage<InputError>(HasSubstr("state.blocks")));
}

}  // namespace
}  // namespace tera
