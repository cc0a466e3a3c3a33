#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/effects.h"
#include "physics/actuation_mechanisms.h"
#include "physics/machine_fixture.h"
#include "physics/payload.h"

namespace tera {
namespace {

/// What docs/mechanisms.md says of one mechanism: the chapter it stands in and, by name, the unit
/// and range of each parameter.
struct Entry {
  std::string slot;
  std::map<std::string, std::string> parameters;
};

/// The text between the first two `quote`s of a line.
std::string Quoted(const std::string& line, char quote = '`') {
  const std::size_t first = line.find(quote), second = line.find(quote, first + 1);
  return second == std::string::npos ? "" : line.substr(first + 1, second - first - 1);
}

/// Chapters are `## slot`, mechanisms "### `id`", parameters "| `name` | unit | a to b |".
std::map<std::string, Entry> Documented() {
  std::map<std::string, Entry> entries;
  std::string slot, id;
  std::ifstream file("docs/mechanisms.md");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) {
      slot = line.substr(3);
      id.clear();
    } else if (line.starts_with("### ")) {
      id = Quoted(line);
      entries[id].slot = slot;
    } else if (line.starts_with("| `") && !id.empty()) {
      const std::string cells = line.substr(line.find("` | ") + 4);
      const std::size_t unit = cells.find(" | ");
      entries[id].parameters[Quoted(line)] = cells.substr(0, cells.find(" |", unit + 1));
    }
  }
  return entries;
}

TEST(ActuationMechanisms, AreDocumentedWithEveryParameterItsUnitAndItsRange) {
  std::map<std::string, Entry> entries = Documented();
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    const std::string id(mechanism.id);
    ASSERT_TRUE(entries.contains(id)) << id;
    EXPECT_EQ(entries[id].slot, NameOf(mechanism.slot)) << id;
    std::map<std::string, std::string> parameters;
    for (const EffectParameter& parameter : mechanism.parameters) {
      parameters[std::string(parameter.name)] =
          fmt::format("{} | {:g} to {:g}", parameter.unit, parameter.lower, parameter.upper);
    }
    EXPECT_EQ(entries[id].parameters, parameters) << id;
  }
}

TEST(ActuationMechanisms, AreAllThatTheirChaptersDescribe) {
  std::set<std::string> slots, known;
  for (const Mechanism& mechanism : ActuationMechanisms()) {
    slots.insert(std::string(NameOf(mechanism.slot)));
    EXPECT_TRUE(known.insert(std::string(mechanism.id)).second) << mechanism.id;
  }
  EXPECT_EQ(slots.size(), 6u);
  for (const auto& [id, entry] : Documented()) {
    EXPECT_TRUE(known.contains(id) || !slots.contains(entry.slot)) << id;
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
      try {
        config.Finish();
        ADD_FAILURE() << text;
      } catch (const InputError& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr(fmt::format("{}.{}: ", mechanism.id, wrong.name)));
        EXPECT_THAT(e.what(), testing::HasSubstr("out of range"));
      }
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
