#include "physics/actuation/actuation_mechanisms.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/faults.h"
#include "core/types/effects.h"
#include "physics/description/payload.h"
#include "physics/machine_fixture.h"

namespace tera {
namespace {

using enum FaultKind;

TEST(ActuationMechanisms, HaveEachItsOwnId) {
  std::set<std::string_view> known;
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    EXPECT_TRUE(known.insert(mechanism.id).second) << mechanism.id;
  }
}

TEST(ActuationMechanisms, HaveDefaultsWithinTheirRanges) {
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    for (const EffectParameter& parameter : mechanism.parameters) {
      EXPECT_LT(parameter.lower, parameter.upper) << mechanism.id << "." << parameter.name;
      if (!parameter.otherwise) continue;
      EXPECT_GE(*parameter.otherwise, parameter.lower) << mechanism.id << "." << parameter.name;
      EXPECT_LE(*parameter.otherwise, parameter.upper) << mechanism.id << "." << parameter.name;
    }
  }
}

TEST(ActuationMechanisms, NumbersBeyondTheirRangeAreReportedForEveryParameter) {
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    const EffectTarget target = mechanism.targets[0];
    for (const EffectParameter& wrong : mechanism.parameters) {
      std::string text = std::string(mechanism.id) + ": {";
      for (const EffectParameter& parameter : mechanism.parameters) {
        const double value =
            parameter.name == wrong.name ? parameter.upper * 1.01 + 1 : parameter.upper;
        text += fmt::format("{}: {}, ", parameter.name, value);
      }
      const Config config = Config::FromText(text + "}", "effects.yaml");
      ReadEffects(config.root(), target, ActuationMechanisms());
      EXPECT_THAT(
          [&] { config.Finish(); },
          ThrowsFault(FaultKind::kOutOfRange, fmt::format("{}.{}", mechanism.id, wrong.name)))
          << text;
    }
  }
}

TEST(ActuationMechanisms, EveryParameterOfAPayloadChangesTheLink) {
  const auto link = [](const std::string& payload) {
    MachineModel model =
        WithEffects(MachineFromText(kLiftArm), "lift: {payload: {" + payload + "}}");
    AddPayloads(&model);
    return model.links[1];
  };
  // 20 kg at 0.8 m and 5 kg at (1.8, 0.5, -0.5): mass 25, centre at (1, 0.1, -0.1).
  const Link loaded = link("mass_kg: 5, x_m: 1.8, y_m: 0.5, z_m: -0.5");
  EXPECT_DOUBLE_EQ(loaded.mass_kg, 25);
  EXPECT_TRUE(loaded.com_B_m.isApprox(Vec3(1, 0.1, -0.1), 1e-12));
  // The reduced mass of the two is 4 kg, (1, 0.5, -0.5) m apart.
  EXPECT_NEAR(loaded.inertia_B_kgm2(0, 0), 0.2 + 4 * 0.5, 1e-12);
  EXPECT_NEAR(loaded.inertia_B_kgm2(1, 1), 3.0 + 4 * 1.25, 1e-12);
  EXPECT_NEAR(loaded.inertia_B_kgm2(2, 2), 3.1 + 4 * 1.25, 1e-12);
  EXPECT_NEAR(loaded.inertia_B_kgm2(0, 1), -4 * 0.5, 1e-12);
  EXPECT_NEAR(loaded.inertia_B_kgm2(1, 2), 4 * 0.25, 1e-12);
}

}  // namespace
}  // namespace tera
