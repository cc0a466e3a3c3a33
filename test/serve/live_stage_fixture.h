#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/error.h"
#include "own_folder.h"
#include "serve/live_stage.h"
#include "serve/session.h"

/// A digger and a rover on a small site, used without a socket and without a camera.

namespace tera {

inline constexpr const char* kStageScenario = R"(
name: stage
seed: 5
duration_s: 2
settle_s: 0.2
terrain: {size_m: [16, 16], cell_m: 0.1, soil: dirt, relief: {amplitude_m: 0.1, wavelength_m: 5}}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [1, -2], yaw_deg: 30, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: idle}
    rig: {sensors: [
      {name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.3], rate_hz: 100},
      {name: gnss, preset: tera:config/sensors/rtk_f9p.yaml, link: upper, xyz_m: [-0.9, 0.5, 1.2], rate_hz: 10},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0.3, 2.1], columns: 64, rate_hz: 10},
      {name: encoders, preset: tera:config/sensors/encoder.yaml, rate_hz: 50}]}
  - name: rover
    machine: tera:config/machines/warthog.yaml
    start: {xy_m: [-5, 4], yaw_deg: -70}
    operator: {type: idle}
    rig: {sensors: [{name: imu, preset: tera:config/sensors/xsens_mti_670.yaml, link: chassis}]}
)";

/// Source of a scenario's text.
inline ScenarioSource SourceOfText(const std::string& text, const std::string& name) {
  const auto file = std::make_shared<const std::filesystem::path>(OwnFolder() / name);
  std::ofstream(*file) << text;
  return SourceOf([file](std::optional<std::uint64_t> seed) {
    return LoadScenario(
        *file, seed ? std::vector{fmt::format("seed={}", *seed)} : std::vector<std::string>{});
  });
}

inline SeededScenario Source(std::optional<std::uint64_t> seed) {
  static const ScenarioSource source = SourceOfText(kStageScenario, "stage.yaml");
  return source(seed);
}

inline std::unique_ptr<Stage> NewStage(
    const StageOptions& options = {}, std::function<bool()> ended = [] { return false; }) {
  return LiveStages(*Source(std::nullopt).scenario, Source, options,
                    [](const std::string&) {})(std::move(ended));
}

inline v1::Step StepOf(std::uint32_t physics_steps) {
  v1::Step step;
  step.set_physics_steps(physics_steps);
  return step;
}

/// Index of a machine's lever of that name.
inline int LeverOf(const v1::Machine& machine, const std::string& name) {
  for (int k = 0; k < machine.levers_size(); ++k) {
    if (machine.levers(k).name() == name) return k;
  }
  ADD_FAILURE() << "no lever " << name;
  return 0;
}

inline int JointOf(const v1::Machine& machine, const std::string& name) {
  for (int k = 0; k < machine.joints_size(); ++k) {
    if (machine.joints(k).name() == name) return k;
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

class LiveStageTest : public testing::Test {
 protected:
  v1::Observation Reset(std::uint64_t seed = 1) {
    v1::Reset reset;
    reset.set_seed(seed);
    return stage_->Reset(reset).value();
  }
  v1::Observation Step(const v1::Step& step) { return stage_->Step(step).value(); }
  void ExpectRefused(const v1::Step& step, const std::string& words) {
    try {
      stage_->Step(step);
      FAIL() << "done: " << step.ShortDebugString();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
  }
  /// One lever of the digger at `position`, the others at rest.
  v1::Step Lever(const std::string& name, double position, std::uint32_t physics_steps) {
    v1::Step step = StepOf(physics_steps);
    v1::Action& action = *step.add_actions();
    action.set_machine("digger");
    for (int k = 0; k < digger_.levers_size(); ++k) action.mutable_levers()->add_position(0);
    action.mutable_levers()->set_position(LeverOf(digger_, name), position);
    return step;
  }
  double JointAt(const v1::Observation& observation, const std::string& name) const {
    return observation.machines(0).joint_position(JointOf(digger_, name));
  }

  std::unique_ptr<Stage> stage_ = NewStage();
  v1::Description description_ = stage_->Describe(0);
  v1::Machine digger_ = description_.machines(0);
};

}  // namespace tera
