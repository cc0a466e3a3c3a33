#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config.h"
#include "core/error.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"
#include "sensors/sensor_kinds.h"
#include "sensors/sensor_mechanisms.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/scenario_text.h"

// The scenario.yaml in a dataset, with all defaults, serves to generate, replay and serve it again.
// Effects must be readable from it.

namespace tera {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// An excavator whose axes all turn.
constexpr const char* kOneExcavator = R"(
machines:
  - name: m
    machine: tera:config/machines/tb235.yaml
    operator: {type: idle}
    ground: GROUND
    rig:
      sensors:
        - {name: imu, preset: 'tera:config/sensors/xsens_mti_670.yaml', link: boom}
        - {name: left, preset: 'tera:config/sensors/rtk_f9p.yaml', link: upper}
        - {name: right, preset: 'tera:config/sensors/rtk_f9p.yaml', link: upper}
        - {name: camera, preset: 'tera:config/sensors/rgb_640.yaml', link: upper, depth: true}
        - {name: lidar, preset: 'tera:config/sensors/vlp16.yaml', link: upper}
        - {name: encoders, preset: 'tera:config/sensors/encoder.yaml'}
)";

/// Each axis of the gantry has encoders, and so has the pair.
const std::string& OfGantry() {
  static const std::string machine = Gantry("m", R"(
      {name: both, preset: 'tera:config/sensors/encoder.yaml'},
      {name: slides, preset: 'tera:config/sensors/encoder.yaml', joints: [slide]},
      {name: turns, preset: 'tera:config/sensors/encoder.yaml', joints: [turn]})");
  return machine;
}

/// A name with effects.
struct Place {
  std::string name;
  EffectTarget target;
  bool turns = true, slides = true;  ///< parameters whose units an encoder accepts; all of them at
                                     ///< other places
};

const std::vector<Place> kOfExcavator = {
    {"boom", EffectTarget::kJoint},
    {"left_track", EffectTarget::kGear},
    {"pump_1", EffectTarget::kPump},
    {"base", EffectTarget::kBase},
    {"imu", EffectTarget::kImu},
    {"left", EffectTarget::kGnss},
    {"camera", EffectTarget::kCamera},
    {"lidar", EffectTarget::kLidar},
    {"encoders", EffectTarget::kEncoder, true, false},
    {"encoders/boom", EffectTarget::kEncoderAxis, true, false},
};
const std::vector<Place> kOfGantry = {
    {"slide", EffectTarget::kJoint},
    {"turn", EffectTarget::kJoint},
    {"both", EffectTarget::kEncoder},
    {"both/slide", EffectTarget::kEncoderAxis, false, true},
    {"both/turn", EffectTarget::kEncoderAxis, true, false},
    {"slides", EffectTarget::kEncoder, false, true},
    {"turns", EffectTarget::kEncoder, true, false},
};

/// Sensor kinds absent from these places, each on the excavator under its own name.
std::vector<const SensorKind*> OtherKinds() {
  std::vector<const SensorKind*> others;
  for (const SensorKind* kind : kSensorKinds) {
    if (std::none_of(kOfExcavator.begin(), kOfExcavator.end(),
                     [&](const Place& place) { return place.target == kind->target; })) {
      others.push_back(kind);
    }
  }
  return others;
}

std::string ExcavatorWithAllKinds() {
  std::string machine = kOneExcavator;
  for (const SensorKind* kind : OtherKinds()) {
    machine +=
        fmt::format("        - {{name: {0}, type: {0}, link: upper, rate_hz: 50}}\n", kind->name);
  }
  return machine;
}

std::vector<Place> PlacesOfAllKinds() {
  std::vector<Place> places = kOfExcavator;
  for (const SensorKind* kind : OtherKinds()) {
    places.push_back({std::string(kind->name), kind->target});
  }
  return places;
}

/// A site with one machine that has these effects, "boom: {dead_band: {width: 0.1}}".
std::string ScenarioWith(std::string machine, std::string_view ground, const std::string& effects) {
  if (const auto at = machine.find("GROUND"); at != machine.npos) machine.replace(at, 6, ground);
  return fmt::format(
      "name: test\nduration_s: 1\n"
      "terrain: {{size_m: [12, 12], cell_m: 0.2, soil: dirt}}\n"
      "{}effects: {{m: {{{}}}}}\n",
      machine, effects);
}

void List(std::string_view place, const Effects& effects, std::vector<std::string>* listed) {
  for (const Effect& effect : effects) {
    listed->push_back(
        fmt::format("{}.{}: {}", place, effect.mechanism->id, fmt::join(effect.values, " ")));
  }
}

/// All effects of the single machine and its sensors.
std::vector<std::string> EffectsOf(const Scenario& scenario) {
  std::vector<std::string> listed;
  const MachineModel& model = scenario.machines.at(0).placement.model;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    List(model.joints[j].name, model.effects.joints[j], &listed);
  }
  for (std::size_t g = 0; g < model.effects.gears.size(); ++g) {
    List(model.ground_tools.gears[g].name, model.effects.gears[g], &listed);
  }
  for (std::size_t p = 0; p < model.effects.pumps.size(); ++p) {
    List(model.pumps[p].name, model.effects.pumps[p], &listed);
  }
  List("base", model.effects.base, &listed);
  for (const SensorDescription& sensor : scenario.machines.at(0).sensors) {
    List(sensor.name, sensor.effects, &listed);
    for (const auto& [axis, effects] : sensor.axis_effects) {
      List(sensor.name + "/" + axis, effects, &listed);
    }
  }
  return listed;
}

/// Whether one of these is the place's mechanism.
bool Has(const std::vector<std::string>& effects, const Place& place, std::string_view mechanism) {
  const std::string start = fmt::format("{}.{}:", place.name, mechanism);
  return std::any_of(effects.begin(), effects.end(),
                     [&](const std::string& effect) { return effect.starts_with(start); });
}

struct Reading {
  std::string faults, resolved;
  std::vector<std::string> effects;
};

Reading Read(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
  Reading reading;
  try {
    const Config config = Config::FromText(yaml, "s.yaml", overrides);
    const Scenario scenario = ReadScenario(config.root());
    config.Finish();
    reading.resolved = config.ResolvedYaml();
    reading.effects = EffectsOf(scenario);
  } catch (const InputError& e) {
    reading.faults = e.what();
  }
  return reading;
}

/// Whether a parameter of this unit can act at the place.
bool CanAct(const EffectParameter& parameter, const Place& place) {
  const std::string_view unit = parameter.unit;
  if (unit == "m" || unit == "m/s" || unit == "m/K") return place.slides;
  return place.turns || !unit.starts_with("deg");
}

/// A value of the range other than the default; small for a rate, which no drive reaches otherwise.
double Another(const EffectParameter& parameter) {
  const double small = std::string_view(parameter.unit) == "rad/s" ? 0.1 : 0.5;
  const double one = std::clamp(parameter.whole ? 1.0 : small, parameter.lower, parameter.upper);
  return parameter.otherwise != one ? one : 0.5 * (parameter.lower + one);
}

/// Form of a mechanism's parameters in YAML, or removal of the effect.
enum class Given { kTakenAway, kRequired, kDefaults, kAllThatCanAct };

std::string Mapping(const Mechanism& mechanism, const Place& place, Given given) {
  std::vector<std::string> items;
  for (const EffectParameter& p : mechanism.parameters) {
    const bool needed = !p.otherwise || (mechanism.id == "axis_flip" && p.name == "y");
    if (needed || (given == Given::kAllThatCanAct && CanAct(p, place))) {
      items.push_back(fmt::format("{}: {}", p.name, Another(p)));
    } else if (given == Given::kDefaults) {
      items.push_back(fmt::format("{}: {}", p.name, *p.otherwise));
    }
  }
  return fmt::format("{{{}}}", fmt::join(items, ", "));
}

/// Whether the mechanism is allowed there: some need a joint with a cylinder, or tracks with
/// kinematic slip.
bool ActsAt(const Mechanism& mechanism, const Place& place, std::string_view ground) {
  if (!mechanism.ActsOn(place.target)) return false;
  const std::string_view id = mechanism.id;
  if (id == "cylinder_lever") return place.name == "boom";
  const bool of_any_ground = id == "track_scale" || id == "track_asymmetry" ||
                             id == "soil_strength" || id == "terrain_height";
  return mechanism.slot != Slot::kGround || of_any_ground || ground == "kinematic";
}

/// Reads each mechanism of `library` at all its possible places, then again from the resolved text.
/// Returns the number of mechanisms.
std::size_t ReadAllTwice(const std::string& machine, std::string_view ground,
                         const std::vector<Place>& places, std::span<const Mechanism> library) {
  std::size_t count = 0;
  for (const Mechanism& mechanism : library) {
    using enum Given;
    bool acts = false;
    for (const Given given : {kTakenAway, kRequired, kDefaults, kAllThatCanAct}) {
      std::vector<std::string> effects, overrides;
      for (const Place& place : places) {
        if (!ActsAt(mechanism, place, ground)) continue;
        effects.push_back(fmt::format("{}: {{{}: {}}}", place.name, mechanism.id,
                                      Mapping(mechanism, place, given)));
        if (given != kTakenAway) continue;
        overrides.push_back(fmt::format("effects.m.{}.{}=none", place.name, mechanism.id));
      }
      if (effects.empty()) continue;
      acts = true;
      const std::string text = fmt::format("{}", fmt::join(effects, ", "));
      SCOPED_TRACE(text);
      const Reading first = Read(ScenarioWith(machine, ground, text), overrides);
      EXPECT_EQ(first.faults, "");
      const Reading again = Read(first.resolved);
      EXPECT_EQ(again.faults, "");
      EXPECT_EQ(again.resolved, first.resolved);
      EXPECT_EQ(again.effects, first.effects);
      for (const Place& place : places) {
        EXPECT_EQ(Has(first.effects, place, mechanism.id),
                  given != kTakenAway && ActsAt(mechanism, place, ground));
      }
    }
    count += acts;
  }
  return count;
}

TEST(EffectRoundTrip, EveryMechanismOfActuationReadsAgainFromTheResolvedScenario) {
  const auto library = ActuationMechanisms();
  EXPECT_EQ(ReadAllTwice(kOneExcavator, "terramechanics", kOfExcavator, library), library.size());
  ReadAllTwice(OfGantry(), "terramechanics", kOfGantry, library);
}

TEST(EffectRoundTrip, EveryMechanismOfTheGroundReadsAgainOnEveryKindOfGround) {
  const auto library = GroundMechanisms();
  EXPECT_EQ(ReadAllTwice(kOneExcavator, "kinematic", kOfExcavator, library), library.size());
  EXPECT_EQ(ReadAllTwice(kOneExcavator, "ideal", kOfExcavator, library), 4u);
  EXPECT_EQ(ReadAllTwice(kOneExcavator, "terramechanics", kOfExcavator, library), 4u);
}

TEST(EffectRoundTrip, EveryMechanismOfASensorReadsAgainOnAxesThatTurnAndThatSlide) {
  const auto library = SensorMechanisms();
  EXPECT_EQ(ReadAllTwice(ExcavatorWithAllKinds(), "kinematic", PlacesOfAllKinds(), library),
            library.size());
  EXPECT_GT(ReadAllTwice(OfGantry(), "terramechanics", kOfGantry, library), 10u);
}

TEST(EffectRoundTrip, WhatWasLearnedReadsAgainAndNoneTakesItAway) {
  const std::string text =
      ScenarioWith(kOneExcavator, "kinematic",
                   "left_track: {learned: {variable: lever_way/left_track, unit: 1, as: added, "
                   "at: [-1, 0, 1], value: [0.1, 0, -0.1], low: [0, 0, -0.2], high: [0.2, 0, 0]}}");
  const Reading first = Read(text);
  EXPECT_EQ(first.faults, "");
  EXPECT_THAT(first.resolved, HasSubstr("value: [0.1, 0, -0.1]"));
  const Reading again = Read(first.resolved);
  EXPECT_EQ(again.faults, "");
  EXPECT_EQ(again.resolved, first.resolved);
  const Reading taken = Read(text, {"effects.m.left_track.learned=none"});
  EXPECT_EQ(taken.faults, "");
  EXPECT_THAT(taken.resolved, Not(HasSubstr("lever_way")));
}

TEST(EffectRoundTrip, ShippedExampleOfEveryEffectOfASensorReadsAgain) {
  const Config config =
      Config::FromFile("config/scenarios/quickstart.yaml",
                       {"terrain.cell_m=0.25", "machines[0].rig=examples/effects/sensor_rig.yaml"},
                       {{"examples/effects/sensor_effects.yaml", "effects"}});
  ReadScenario(config.root());
  config.Finish();
  const Reading again = Read(config.ResolvedYaml());
  EXPECT_EQ(again.faults, "");
  EXPECT_EQ(again.resolved, config.ResolvedYaml());
  EXPECT_THAT(again.effects, Not(IsEmpty()));
}

}  // namespace
}  // namespace tera
