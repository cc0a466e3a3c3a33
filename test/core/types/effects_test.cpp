#include "core/types/effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/faults.h"
#include "own_folder.h"

namespace tera {
namespace {

using enum FaultKind;

const std::vector<Mechanism>& Library() {
  static const std::vector<Mechanism> library = {
      {"dead_band", Slot::kLeverMap, {EffectTarget::kJoint}, {{"width", "1", 0, 0.9, {}}}},
      {"lag", Slot::kActuator, {EffectTarget::kJoint}, {{"time_s", "s", 0, 2, 0.25}}},
      {"count", Slot::kFlow, {EffectTarget::kJoint}, {{"n", "1", 0, 3, 2.0, true}}},
      {"bias", Slot::kSensorStatic, {EffectTarget::kImu}, {{"x", "1", -1, 1, 0.0}}},
  };
  return library;
}

/// The effects of the boom in `text`, a machine's mapping with `effects:`, under `upper`.
Effects BoomEffects(const std::string& text, const std::string& upper = "{machine: {}}") {
  const Config config = Config::FromText(text, "machine.yaml");
  const Config over = Config::FromText(upper, "scenario.yaml");
  const auto map = config.root().OptionalMapUnder("effects", over.root(), "machine");
  Effects effects;
  if (map) effects = ReadEffects(map->Map("boom"), EffectTarget::kJoint, Library());
  config.Finish();
  over.Finish();
  return effects;
}

std::vector<InputFault> FaultsOfBoom(const std::string& text,
                                     const std::string& upper = "{machine: {}}") {
  return FaultsIn([&] { BoomEffects(text, upper); });
}

TEST(Effects, HoldTheNumbersOfTheirMechanismAndItsDefaults) {
  const Effects effects = BoomEffects("effects: {boom: {dead_band: {width: 0.2}, lag: {}}}");
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ((*FindEffect(effects, "dead_band"))["width"], 0.2);
  EXPECT_EQ((*FindEffect(effects, "lag"))["time_s"], 0.25);
  EXPECT_EQ(FindEffect(effects, "bias"), nullptr);
}

TEST(Effects, OfAScenarioLieOverThoseOfTheMachineAndCanTakeThemAway) {
  const std::string machine = "effects: {boom: {dead_band: {width: 0.2}, lag: {time_s: 1}}}";
  const Effects effects =
      BoomEffects(machine, "{machine: {boom: {dead_band: {width: 0.1}, lag: none}}}");
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0]["width"], 0.1);
}

TEST(Effects, GivenAgainAboveATakingAwayStartAfresh) {
  const std::filesystem::path& folder = OwnFolder();
  std::ofstream(folder / "base.yaml")
      << "effects: {boom: {dead_band: {width: 0.2}, lag: {time_s: 1}}}\n";
  std::ofstream(folder / "take.yaml") << "effects: {boom: {dead_band: none, lag: none}}\n";
  std::ofstream(folder / "give.yaml") << "effects: {boom: {dead_band: {width: 0.3}, lag: {}}}\n";
  const Config config =
      Config::FromFile(folder / "base.yaml", {},
                       {{folder / "take.yaml", "effects"}, {folder / "give.yaml", "effects"}});
  const Effects effects =
      ReadEffects(config.root().Map("effects").Map("boom"), EffectTarget::kJoint, Library());
  config.Finish();
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ((*FindEffect(effects, "dead_band"))["width"], 0.3);
  EXPECT_EQ((*FindEffect(effects, "lag"))["time_s"], 0.25);  // not the removed 1 s
}

TEST(Effects, ReportWhatIsUnknownMissingOrOutOfRange) {
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {dead_bend: {width: 0.2}}}"),
              HasFault(kUnknown, "effects.boom.dead_bend"));
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {dead_band: {}}}"),
              HasFault(kMissing, "effects.boom.dead_band.width"));
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {dead_band: {width: 2}}}"),
              HasFault(kOutOfRange, "dead_band.width"));
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {bias: {x: 0}}}"),
              HasFault(kInconsistent, "effects.boom.bias"));
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {count: {n: 1.5}}}"), HasFault(kMistyped, "count.n"));
}

TEST(Effects, AreFaultyWhereTheyWereWrittenAndByTheKeysThatStandThere) {
  const std::string machine = "effects: {boom: {dead_band: {width: 0.2}}}";
  EXPECT_THAT(
      FaultsOfBoom("effects: {boom: {dead_band: {width: 2}}}", "{machine: {boom: {lag: {}}}}"),
      HasOnlyFault(kOutOfRange, "machine.yaml:1:37: effects.boom.dead_band.width"));
  EXPECT_THAT(FaultsOfBoom(machine, "{machine: {boom: {dead_band: {width: 2}}}}"),
              HasOnlyFault(kOutOfRange, "scenario.yaml:1:38: machine.boom.dead_band.width"));
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {}}", "{machine: {boom: {dead_band: {}}}}"),
              HasOnlyFault(kMissing, "scenario.yaml:1:30: machine.boom.dead_band.width"));
  EXPECT_THAT(FaultsOfBoom(machine, "{machine: {boom: {dead_bend: {width: 0.1}}}}"),
              HasOnlyFault(kUnknown, "scenario.yaml:1:19: machine.boom.dead_bend"));
  EXPECT_THAT(FaultsOfBoom(machine, "{machine: {boom: {bias: {x: 0}}}}"),
              HasFault(kInconsistent, "scenario.yaml:1:25: machine.boom.bias"));
}

TEST(Effects, AreMappingsOfTheirParametersOrNone) {
  for (const char* value : {"0.1", "off", "[0.1]", ""}) {
    EXPECT_THAT(FaultsOfBoom("effects: {boom: {dead_band: " + std::string(value) + "}}"),
                HasOnlyFault(kMistyped, "effects.boom.dead_band"));
  }
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {dead_band: {width: 0.2}}}",
                           "{machine: {boom: {dead_band: 0.1}}}"),
              HasOnlyFault(kMistyped, "scenario.yaml:1:30: machine.boom.dead_band"));
}

TEST(Effects, ThatNothingBelowHasCannotBeTakenAway) {
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {lag: none}}"),
              HasFault(kInconsistent, "machine.yaml:1:23: effects.boom.lag"));
  EXPECT_THAT(
      FaultsOfBoom("effects: {boom: {dead_band: {width: 0.2}}}", "{machine: {boom: {lag: none}}}"),
      HasFault(kInconsistent, "scenario.yaml:1:24: machine.boom.lag"));
  // Nor by a layer below another.
  EXPECT_THAT(FaultsOfBoom("effects: {boom: {lag: none}}", "{machine: {boom: {lag: {}}}}"),
              HasFault(kInconsistent, "machine.yaml:1:23: effects.boom.lag"));
}

TEST(Effects, TakenAwayAreNotInTheResolvedDocument) {
  const Config config = Config::FromText("{boom: {dead_band: {width: 0.2}, lag: {}}}",
                                         "machine.yaml", {"boom.dead_band=none"});
  ReadEffects(config.root().Map("boom"), EffectTarget::kJoint, Library());
  config.Finish();
  const Config again = Config::FromText(config.ResolvedYaml(), "again.yaml");
  const Effects effects = ReadEffects(again.root().Map("boom"), EffectTarget::kJoint, Library());
  again.Finish();
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].mechanism->id, "lag");
}

TEST(Effects, ComeFromAFileOfTheirOwnOverAConfiguration) {
  const std::filesystem::path& folder = OwnFolder();
  std::ofstream(folder / "machine.yaml") << "kind: cart\neffects: {boom: {lag: {}}}\n";
  std::ofstream(folder / "effects.yaml") << "effects: {boom: {lag: {time_s: 0.5}}}\n";
  std::ofstream(folder / "other.yaml") << "effects: {}\nkind: ship\n";
  const auto file = folder / "machine.yaml";
  const Config config = Config::FromFile(file, {}, {{folder / "effects.yaml", "effects"}});
  EXPECT_EQ(config.root().Text("kind"), "cart");
  // Beside several overrides too.
  const Config overridden =
      Config::FromFile(file, {"a=1", "b=2"}, {{folder / "effects.yaml", "effects"}});
  EXPECT_EQ(overridden.root().Text("kind"), "cart");
  EXPECT_EQ(overridden.root().Text("b"), "2");
  const ConfigMap boom = config.root().Map("effects").Map("boom");
  EXPECT_EQ(ReadEffects(boom, EffectTarget::kJoint, Library())[0]["time_s"], 0.5);
  const auto read = [&](const char* name) {
    Config::FromFile(file, {}, {{folder / name, "effects"}});
  };
  EXPECT_THROW(read("other.yaml"), InputError);
  EXPECT_THROW(read("absent.yaml"), InputError);
}

}  // namespace
}  // namespace tera
