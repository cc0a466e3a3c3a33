#include "sim/scenario/read_tolerances.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/faults.h"
#include "sim/scenario/scenario_text.h"

namespace tera {
namespace {

using enum FaultKind;

/// The excavator with an inertial unit and the encoders of its boom, and these tolerances.
std::string WithTolerances(const std::string& tolerances) {
  return WithRig(
             "{name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom}, "
             "{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [boom]}") +
         "tolerances: " + tolerances + "\n";
}

Tolerances TolerancesOf(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  const Config config = Config::FromText(yaml, "s.yaml", overrides);
  const Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario.machines[0].tolerances;
}

TEST(ReadTolerances, AreOfJointsTracksPumpsSensorsAxesAndTheBase) {
  const Tolerances read = TolerancesOf(WithTolerances(
      "{excavator1: {boom: {dead_band: {width: 0.03}}, left_track: {rate_gain: {gain: 0.1}}, "
      "imu_boom: {mount_rotation: {pitch_deg: 2}}, encoders/boom: {bias: {angle_deg: 1}}, "
      "base: {effective_gauge: {ratio: 0.2}}}}"));
  std::vector<std::string> found;
  for (const Tolerance& one : read) {
    found.push_back(fmt::format("{} {} {} {}", one.target, one.mechanism->id,
                                one.mechanism->parameters[one.parameter].name, one.half_width));
  }
  EXPECT_THAT(found, testing::UnorderedElementsAre(
                         "boom dead_band width 0.03", "left_track rate_gain gain 0.1",
                         "imu_boom mount_rotation pitch_deg 2", "encoders/boom bias angle_deg 1",
                         "base effective_gauge ratio 0.2"));
}

TEST(ReadTolerances, OfTheScenarioStandOverThoseOfTheMachinesFile) {
  const Tolerances read =
      TolerancesOf(WithTolerances("{excavator1: {boom: {dead_band: {width: 0.03}}}}"),
                   {"machines[0].machine.tolerances={boom: {dead_band: {width: 0.5}}}"});
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].half_width, 0.03);
}

TEST(ReadTolerances, NegativeAndUnknownOnesAreRefusedByTheirPlace) {
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {boom: {dead_band: {width: -0.1}}}}")),
              HasFault(kOutOfRange, "tolerances.excavator1.boom.dead_band.width"));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {boom: {dead_band: {widht: 0.1}}}}")),
              HasFault(kUnknown, "dead_band.widht"));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {boom: {dead_bant: {width: 0.1}}}}")),
              HasFault(kUnknown, "tolerances.excavator1.boom.dead_bant"));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {bom: {dead_band: {width: 0.1}}}}")),
              HasFault(kUnknown, "tolerances.excavator1.bom"));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{digger: {boom: {dead_band: {width: 0.1}}}}")),
              HasFault(kUnknown, "tolerances.digger"));
}

TEST(ReadTolerances, ValuesWhereMappingsBelongAreRefused) {
  EXPECT_THAT(ScenarioFaults(WithTolerances("0.1")), HasFaultAt("tolerances"));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: 0.1}")), HasFault(kMistyped));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {boom: 0.1}}")), HasFault(kMistyped));
  EXPECT_THAT(ScenarioFaults(WithTolerances("{excavator1: {boom: {dead_band: 0.1}}}")),
              HasFault(kMistyped));
}

}  // namespace
}  // namespace tera
