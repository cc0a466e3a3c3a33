#include "diagnose/replay/axis_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>

#include "core/error.h"
#include "dataset/format/sample_recording.h"
#include "diagnose/blocks/actuation_candidates.h"
#include "diagnose/blocks/axis_block.h"
#include "diagnose/blocks/candidate_list.h"
#include "diagnose/candidates/candidate_library.h"
#include "sim/drive_fixture.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

/// Recording of a drive: the levers of each step, and ideal encoders at 100 Hz.
struct Recorded {
  TableRecording commands;
  NamedEncoders encoders{"m/encoders", {}};
};

Recorded Record(Drive* drive, double duration_s) {
  const MachineModel& model = drive->scenario.machines[0].placement.model;
  Recorded recorded;
  for (const Lever& lever : model.levers) recorded.commands.columns.push_back(lever.name);
  for (const Joint& joint : model.joints) {
    recorded.encoders.recording.axes.push_back({joint.name});
  }
  constexpr TimeNs kPeriod_ns = kNsPerSecond / 100;
  TimeNs before_ns = drive->simulation->state().t_ns;
  drive->Run(duration_s, [&] {
    const TimeNs t_ns = drive->simulation->state().t_ns;
    const MachineState& state = drive->machine();
    recorded.commands.t_ns.push_back(before_ns);
    recorded.commands.rows.push_back(state.levers);
    before_ns = t_ns;
    if (t_ns % kPeriod_ns == 0) {
      recorded.encoders.recording.samples.push_back(
          {.t_ns = t_ns, .q_rad = state.q_rad, .qd_radps = state.qd_radps});
    }
  });
  return recorded;
}

/// Boom, arm and bucket move in the air, at many speeds and simultaneously.
NamedLevers Sway(double t_s) {
  return {{"boom", 0.5 * std::sin(1.1 * t_s)},
          {"arm", 0.6 * std::sin(1.5 * t_s + 1)},
          {"bucket", 0.7 * std::sin(2.1 * t_s + 2)}};
}

const char* const kRaised = "{joints_deg: {boom: 40, arm: -80, bucket: -30, blade: 20}}";

Drive Swaying(const std::string& effects) {
  Drive drive("tb235.yaml", kRaised, "soil: dirt", 0, 0, effects);
  drive.Operate(Sway);
  return drive;
}

double Rms(const std::vector<double>& predicted, const MeasuredRate& measured) {
  double square = 0;
  int n = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    if (!measured.is_free[i]) continue;
    const double error_radps = predicted[i] - measured.rate_radps[i];
    square += error_radps * error_radps;
    ++n;
  }
  EXPECT_GT(n, 500);
  return std::sqrt(square / n);
}

/// RMS residual of a replay for a joint's measured rate.
double Residual_radps(const AxisLog& log, const MachineModel& model, const MachineEffects& effects,
                      const std::string& joint) {
  const auto axis = static_cast<std::size_t>(model.JointIndex(joint));
  for (const MeasuredRate& measured : log.measured) {
    if (measured.axis != axis) continue;
    const auto predicted =
        AxisReplay(model, log, measured).Predict({EffectsAt(effects.joints, axis), {}});
    EXPECT_EQ(predicted.size(), measured.rate_radps.size());
    return Rms(predicted, measured);
  }
  ADD_FAILURE() << "no rate of " << joint;
  return 0;
}

struct Case {
  std::string joint, effects;
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.joint << " {" << tested.effects << "}";
}

class ReplayOfEffects : public ::testing::TestWithParam<Case> {};

TEST_P(ReplayOfEffects, TellsWhatTheSimulationDidAndTheIdealChainDoesNot) {
  Drive drive = Swaying("effects: {m: {" + GetParam().joint + ": {" + GetParam().effects + "}}}");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 12);
  const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
  const double with = Residual_radps(log, model, model.effects, GetParam().joint);
  const double without = Residual_radps(log, model, {}, GetParam().joint);
  EXPECT_LT(with, 2e-3);
  EXPECT_GT(without, 5 * with);
}

INSTANTIATE_TEST_SUITE_P(
    Mechanisms, ReplayOfEffects,
    ::testing::Values(Case{"boom", "dead_band: {width: 0.15}"},
                      Case{"arm", "command_delay: {delay_s: 0.2}"},
                      Case{"bucket", "actuator_lag: {time_s: 0.3}"},
                      Case{"arm", "valve_curve: {exponent: 1.6}"},
                      Case{"boom", "cylinder_lever: {reference_rad: 0.7}"},
                      Case{"boom", "pressure_droop: {stall_nm: 60000, response_s: 0.05}"},
                      Case{"arm",
                           "structural_flex: {natural_radps: 8, damping: 0.1, "
                           "compliance_radpnm: 2e-5}"},
                      Case{"arm", "backlash: {gap_rad: 0.02}"}));

TEST(AxisReplay, KnowsWhatItsPumpGivesToOthers) {
  for (const std::string effect :
       {"flow_sharing: {capacity: 0.35}", "power_limit: {power_w: 1200, regulator_s: 0.2}"}) {
    Drive drive = Swaying("effects: {m: {pump_1: {" + effect + "}}}");
    const MachineModel& model = drive.scenario.machines[0].placement.model;
    const Recorded recorded = Record(&drive, 12);
    const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
    const auto boom =
        std::find_if(log.measured.begin(), log.measured.end(), [&](const MeasuredRate& measured) {
          return measured.axis == static_cast<std::size_t>(model.JointIndex("boom"));
        });
    ASSERT_NE(boom, log.measured.end());
    const AxisReplay replay(model, log, *boom);
    const double with = Rms(replay.Predict(replay.effects()), *boom);
    const double without = Rms(replay.Predict({.axis = replay.effects().axis, .pump = {}}), *boom);
    EXPECT_LT(with, 2e-3) << effect;
    EXPECT_GT(without, 5 * with) << effect;
  }
}

TEST(AxisReplay, FallsShortAfterAStepThatAsksForMoreThanTheEffortAndNotInBetween) {
  Drive drive("tb235.yaml", kRaised, "soil: dirt", 0, 0);
  drive.Operate([](double t_s) { return NamedLevers{{"arm", t_s < 1 ? 0.0 : 1.0}}; });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 2);
  const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
  const auto arm =
      std::find_if(log.measured.begin(), log.measured.end(), [&](const MeasuredRate& measured) {
        return measured.axis == static_cast<std::size_t>(model.JointIndex("arm"));
      });
  ASSERT_NE(arm, log.measured.end());
  const AxisReplay replay(model, log, *arm);
  const std::vector<bool> weak = replay.FallsShort(replay.effects(), {.effort = 0.5});
  const std::vector<bool> strong = replay.FallsShort(replay.effects(), {.effort = 1000});
  ASSERT_EQ(weak.size(), arm->at_step.size());
  // Samples come every 10 ms, the first at 10 ms.
  EXPECT_EQ(std::count(weak.begin(), weak.begin() + 98, true), 0) << "at rest";
  EXPECT_GE(std::count(weak.begin() + 98, weak.begin() + 106, true), 2) << "after the step";
  EXPECT_EQ(std::count(weak.begin() + 180, weak.end(), true), 0) << "at a steady rate";
  EXPECT_EQ(std::count(strong.begin(), strong.end(), true), 0);
}

TEST(AxisReplay, FallsShortAtEverySampleThatAWeakDriveChanges) {
  Drive drive("tb235.yaml", kRaised, "soil: dirt", 0, 0);
  drive.Operate([](double t_s) { return NamedLevers{{"arm", t_s < 1 ? 0.0 : 1.0}}; });
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 2);
  const auto check = [&](double step_s) {
    const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, step_s);
    const auto arm =
        std::find_if(log.measured.begin(), log.measured.end(), [&](const MeasuredRate& measured) {
          return measured.axis == static_cast<std::size_t>(model.JointIndex("arm"));
        });
    ASSERT_NE(arm, log.measured.end());
    const AxisReplay replay(model, log, *arm);
    const AxisReplay::Nominal weak = {.effort = 0.05}, strong = {.effort = 1e6};
    const std::vector<bool> marked = replay.FallsShort(replay.effects(), weak);
    const std::vector<double> slow = replay.Predict(replay.effects(), weak);
    const std::vector<double> fast = replay.Predict(replay.effects(), strong);
    int changed = 0, spared = 0;
    for (std::size_t k = 0; k < marked.size(); ++k) {
      const bool differs = std::abs(slow[k] - fast[k]) > 1e-12;
      changed += differs ? 1 : 0;
      spared += differs && !marked[k] ? 1 : 0;
    }
    EXPECT_GE(changed, 20);
    EXPECT_EQ(spared, 0);
    // At most one step too many at each end.
    EXPECT_LE(std::count(marked.begin(), marked.end(), true), changed + 2 * 7 + 1);
  };
  for (const double step_s : {0.002, 0.02, 0.067}) {  // the last with six or seven samples
    SCOPED_TRACE(step_s);
    check(step_s);
  }
}

/// The block of the boom, which shares pump 1 with the bucket.
ReplayBlock BlockOfBoom(const Drive& drive, const Recorded& recorded) {
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.005);
  for (std::size_t m = 0; m < log.measured.size(); ++m) {
    if (log.measured[m].axis != static_cast<std::size_t>(model.JointIndex("boom"))) continue;
    return MakeAxisBlock(model, log, m).value();
  }
  ADD_FAILURE() << "no rate of the boom";
  return {};
}

TEST(AxisBlock, KnowsWhichWayTheLeverWentLast) {
  Drive drive("tb235.yaml", kRaised, "soil: dirt", 0, 0);
  drive.Operate([](double t_s) {
    const double lever = t_s < 1 ? 0.0 : t_s < 2 ? 0.5 : t_s < 3 ? 0.2 : t_s < 4 ? -0.3 : 0.0;
    return NamedLevers{{"boom", lever - (t_s > 1.5 && t_s < 2 ? 0.004 : 0)}};
  });
  const ReplayBlock block = BlockOfBoom(drive, Record(&drive, 5));
  const auto way = std::find_if(
      block.channels[0].variables.begin(), block.channels[0].variables.end(),
      [](const RegimeVariable& variable) { return variable.name == "lever_way/boom"; });
  ASSERT_NE(way, block.channels[0].variables.end());
  const auto at = [&](double t_s) {
    return way->series.value[static_cast<std::size_t>(t_s / block.period_s())];
  };
  EXPECT_EQ(at(0.5), 0);
  EXPECT_EQ(at(1.3), 1);
  EXPECT_EQ(at(1.9), 1) << "held, and trembling";
  EXPECT_EQ(at(2.5), -1) << "back towards neutral";
  EXPECT_EQ(at(3.5), -1) << "out to the other side";
  EXPECT_EQ(at(4.5), 0);
}

TEST(AxisBlock, AsksForTheWayOnlyWhereItIsNotTheSideOfTheLever) {
  const auto has_way = [](const std::function<double(double)>& lever) {
    Drive drive("tb235.yaml", kRaised, "soil: dirt", 0, 0);
    drive.Operate([&](double t_s) { return NamedLevers{{"boom", lever(t_s)}}; });
    const ReplayBlock block = BlockOfBoom(drive, Record(&drive, 8));
    const auto& variables = block.channels[0].variables;
    return std::any_of(variables.begin(), variables.end(), [](const RegimeVariable& variable) {
      return variable.name == "lever_way/boom";
    });
  };
  EXPECT_FALSE(has_way([](double t_s) { return std::fmod(t_s, 2) < 1 ? 1.0 : 0.0; }));
  EXPECT_TRUE(has_way([](double t_s) { return std::sin(2 * t_s); }));
}

/// Some samples are missing, and stamps jitter by up to a millisecond.
Recorded Tattered(Recorded recorded) {
  std::vector<EncoderSample>& samples = recorded.encoders.recording.samples;
  const Stream stream(3, "tatters");
  std::vector<EncoderSample> kept;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool in_gap = k > 900 && k < 930;
    if (in_gap || stream.Uniform(2 * k) < 0.05) continue;
    kept.push_back(samples[k]);
    kept.back().t_ns += FromSeconds(1e-3 * stream.Uniform(2 * k + 1));
  }
  samples = std::move(kept);
  return recorded;
}

// A reader samples one step of the replay: at the next step, every sample differs.
TEST(AxisBlock, BeginsAReaderThatLooksOnceAPeriodAtEveryStepThatItMayLookAt) {
  Drive drive = Swaying("effects: {m: {boom: {input_hold: {period_s: 0.34}}}}");
  const ReplayBlock block = BlockOfBoom(drive, Record(&drive, 22));
  const auto hold =
      std::find_if(block.candidates.begin(), block.candidates.end(),
                   [](const Candidate& one) { return one.mechanism->id == "input_hold"; });
  ASSERT_NE(hold, block.candidates.end());
  const auto rms = [&](const std::vector<double>& values) {
    const std::vector<double> predicted = block.predict({{&*hold, values}})[0];
    double square = 0;
    for (std::size_t k = 0; k < predicted.size(); ++k) {
      if (!block.channels[0].measured.valid[k]) continue;
      square += std::pow(predicted[k] - block.channels[0].measured.value[k], 2);
    }
    return std::sqrt(square);
  };
  double least = rms(hold->starts.front());
  for (const std::vector<double>& start : hold->starts) least = std::min(least, rms(start));
  EXPECT_LT(least, 1.2 * rms({0.34, 0}));
}

// A search may use a prefix only; terms with a memory must not be affected.
TEST(AxisBlock, ABeginningIsThatOfTheWhole) {
  Drive drive = Swaying("");
  const ReplayBlock block = BlockOfBoom(drive, Tattered(Record(&drive, 22)));
  for (const char* id : {"command_delay", "actuator_lag", "backlash", "input_hold"}) {
    const auto candidate =
        std::find_if(block.candidates.begin(), block.candidates.end(),
                     [&](const Candidate& one) { return one.mechanism->id == id; });
    ASSERT_NE(candidate, block.candidates.end()) << id;
    const Structure terms = {{&*candidate, candidate->starts.back()}};
    const std::vector<double> whole = block.predict(terms)[0];
    for (const std::size_t samples :
         {std::size_t{1}, std::size_t{700}, std::size_t{915}, std::size_t{1500}, block.samples()}) {
      const std::vector<double> prefix = block.replay(terms, samples)[0];
      ASSERT_EQ(prefix.size(), samples);
      for (std::size_t k = 0; k < samples; ++k) {
        if (!block.channels[0].measured.valid[k]) continue;
        ASSERT_EQ(prefix[k], whole[k]) << id << " " << samples << " " << k;
      }
    }
  }
}

TEST(AxisBlock, HasTermsOfThePumpThatTheAxisSharesAndPutsThemOnThePump) {
  Drive drive = Swaying("");
  const ReplayBlock block = BlockOfBoom(drive, Record(&drive, 22));
  const auto sharing =
      std::find_if(block.candidates.begin(), block.candidates.end(),
                   [](const Candidate& one) { return one.mechanism->id == "flow_sharing"; });
  ASSERT_NE(sharing, block.candidates.end());
  EXPECT_EQ(sharing->target, "pump_1");
  const Structure terms = {{&*sharing, {0.3}}};
  EXPECT_NE(block.predict(terms), block.predict({}));
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const MachineModel with = WithTerms(model, terms);
  ASSERT_EQ(with.effects.pumps.size(), model.pumps.size());
  ASSERT_NE(FindEffect(with.effects.pumps[0], "flow_sharing"), nullptr);
  EXPECT_EQ((*FindEffect(with.effects.pumps[0], "flow_sharing"))["capacity"], 0.3);
  EXPECT_TRUE(with.effects.pumps[1].empty());
}

TEST(AxisBlock, OfALibraryGetsMechanismsOfPumpsOnPumpsAndOfNothingElse) {
  Drive drive = Swaying("");
  std::vector<ReplayBlock> blocks = {BlockOfBoom(drive, Record(&drive, 22))};
  const ScratchDirectory scratch;
  std::ofstream(scratch.path() / "library.yaml") << "candidates: {bias: {}, flow_sharing: {}}\n";
  ApplyLibrary(ReadCandidateLibrary(scratch.path() / "library.yaml"),
               drive.scenario.machines[0].placement.model, &blocks);
  for (const Candidate& candidate : blocks[0].candidates) {
    EXPECT_NE(candidate.mechanism->id, "bias") << candidate.target;
    if (candidate.target != "pump_1") continue;
    EXPECT_EQ(candidate.mechanism->slot, Slot::kFlow);
  }
}

const Candidate& CandidateOf(const std::vector<Candidate>& candidates, std::string_view id) {
  return *std::find_if(candidates.begin(), candidates.end(),
                       [&](const Candidate& candidate) { return candidate.mechanism->id == id; });
}

TEST(CandidateLibrary, ReadsTheFormerNameOfItsCandidates) {
  const ScratchDirectory scratch;
  std::ofstream(scratch.path() / "library.yaml") << "suspects: {backlash: {gap_rad: 0.01}}\n";
  const CandidateLibrary library = ReadCandidateLibrary(scratch.path() / "library.yaml");
  ASSERT_FALSE(library.ranges.empty());
  EXPECT_EQ(library.ranges.front().first->id, "backlash");
}

TEST(CandidateLibrary, KinksOfALimitedNumberStayAsFarApartAsTheyAre) {
  Drive drive = Swaying("");
  std::vector<ReplayBlock> blocks = {BlockOfBoom(drive, Record(&drive, 22))};
  const auto kinks_s = [&] {
    const FreeParameter& delay = CandidateOf(blocks[0].candidates, "command_delay").free[0];
    return delay.kink * (delay.upper - delay.lower);
  };
  const double before_s = kinks_s();
  EXPECT_GT(before_s, 0);
  const ScratchDirectory scratch;
  std::ofstream(scratch.path() / "library.yaml")
      << "candidates: {command_delay: {delay_s: [0.05, 0.3]}}\n";
  ApplyLibrary(ReadCandidateLibrary(scratch.path() / "library.yaml"),
               drive.scenario.machines[0].placement.model, &blocks);
  EXPECT_EQ(CandidateOf(blocks[0].candidates, "command_delay").free[0].upper, 0.3);
  EXPECT_NEAR(kinks_s(), before_s, 1e-12);
}

TEST(AxisLog, AsksForAnEncoderOfTheMachine) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  Recorded recorded = Record(&drive, 0.1);
  for (EncoderAxis& axis : recorded.encoders.recording.axes) axis.name = "another_" + axis.name;
  EXPECT_THROW(MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002), InputError);
}

TEST(AxisLog, SaysThatClocksDoNotOverlap) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  Recorded recorded = Record(&drive, 0.1);
  for (TimeNs& t_ns : recorded.commands.t_ns) t_ns += 60 * kNsPerSecond;
  try {
    MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
    FAIL() << "clocks without a common time were accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no time in common"));
  }
}

TEST(AxisLog, SaysWhichLeversItNeeds) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  Recorded recorded = Record(&drive, 0.1);
  for (std::string& column : recorded.commands.columns) column += "_volts";
  try {
    MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
    FAIL() << "a recording without levers was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no lever channel"));
    EXPECT_THAT(error.what(), HasSubstr("boom"));
  }
}

const MeasuredRate& RateOf(const AxisLog& log, std::size_t axis) {
  return *std::find_if(log.measured.begin(), log.measured.end(),
                       [&](const MeasuredRate& measured) { return measured.axis == axis; });
}

TEST(CandidatesOfAxis, ARingSwingsBeforeItIsGone) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 12);
  const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
  const auto arm = static_cast<std::size_t>(model.JointIndex("arm"));
  const std::vector<Candidate> candidates = CandidatesOfAxis(model, log, RateOf(log, arm), {});
  const Candidate& ring = CandidateOf(candidates, "actuator_ring");
  EXPECT_TRUE(ring.is_itself({20, 6, 0}));  // as the paper fits a boom
  EXPECT_FALSE(ring.is_itself({6, 20, 0}));
}

/// Upper bound of a mechanism's first parameter in a search, for the arm by the first encoder. 0 if
/// the mechanism is no candidate.
double MostOfArm(const MachineModel& model, const Recorded& recorded,
                 const std::vector<NamedEncoders>& encoders, const std::string& id) {
  const AxisLog log = MakeAxisLog(model, recorded.commands, encoders, 0.002);
  const auto arm = static_cast<std::size_t>(model.JointIndex("arm"));
  std::size_t index = 0;
  while (log.measured[index].axis != arm) ++index;
  const std::optional<ReplayBlock> block = MakeAxisBlock(model, log, index);
  if (!block) return -1;
  for (const Candidate& candidate : block->candidates) {
    if (candidate.mechanism->id != id) continue;
    for (const auto& start : candidate.starts) EXPECT_LE(start[0], candidate.free[0].upper);
    return candidate.free[0].upper;
  }
  return 0;
}

NamedEncoders Every(const NamedEncoders& encoders, TimeNs period_ns) {
  NamedEncoders thinned = encoders;
  std::erase_if(thinned.recording.samples,
                [&](const EncoderSample& sample) { return sample.t_ns % period_ns != 0; });
  return thinned;
}

/// The same number of rows, each holding the last measurement of its period.
NamedEncoders Held(const NamedEncoders& encoders, TimeNs period_ns) {
  NamedEncoders held = encoders;
  EncoderSample last = held.recording.samples.front();
  for (EncoderSample& sample : held.recording.samples) {
    if (sample.t_ns % period_ns == 0) last = sample;
    sample.q_rad = last.q_rad;
    sample.qd_radps = last.qd_radps;
  }
  return held;
}

// Samples at f resolve oscillations up to f / 2: pi f in rad/s.
TEST(CandidatesOfAxis, NothingSwingsFasterThanHalfTheRateOfSamples) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 25);
  const NamedEncoders& fast = recorded.encoders;
  constexpr TimeNs kTenth = kNsPerSecond / 10;
  NamedEncoders slow = Every(fast, kTenth), beside = fast;
  beside.channel = "m/others";
  for (const std::string id : {"structural_flex", "actuator_ring"}) {
    EXPECT_GT(MostOfArm(model, recorded, {fast}, id), 50) << id;
    const double most_radps = std::numbers::pi * 10;
    EXPECT_NEAR(MostOfArm(model, recorded, {slow}, id), most_radps, 1e-6) << id;
    EXPECT_NEAR(MostOfArm(model, recorded, {Held(fast, kTenth)}, id), most_radps, 0.5) << id;
    EXPECT_NEAR(MostOfArm(model, recorded, {slow, beside}, id), most_radps, 1e-6) << id;
  }
}

TEST(CandidatesOfAxis, OfSamplesEveryTwoSecondsNothingSwings) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  Recorded recorded = Record(&drive, 12);
  const NamedEncoders slow = Every(recorded.encoders, 2 * kNsPerSecond);
  const AxisLog log = MakeAxisLog(model, recorded.commands, {slow}, 0.002);
  const auto arm = static_cast<std::size_t>(model.JointIndex("arm"));
  for (const Candidate& candidate : CandidatesOfAxis(model, log, RateOf(log, arm), {})) {
    EXPECT_NE(candidate.mechanism->id, "structural_flex");
    EXPECT_NE(candidate.mechanism->id, "actuator_ring");
  }
}

TEST(CandidatesOfAxis, ADroopMayStallBelowTheLargestLoad) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  const Recorded recorded = Record(&drive, 12);
  const AxisLog log = MakeAxisLog(model, recorded.commands, {recorded.encoders}, 0.002);
  const auto arm = static_cast<std::size_t>(model.JointIndex("arm"));
  double largest_nm = 0;
  for (std::size_t k = 0; k < log.steps; ++k) {
    largest_nm = std::max(largest_nm, std::abs(log.motions_at(k)[arm].load_nm));
  }
  const std::vector<Candidate> candidates = CandidatesOfAxis(model, log, RateOf(log, arm), {});
  const Candidate& droop = CandidateOf(candidates, "pressure_droop");
  EXPECT_LT(droop.free[0].lower, 0.8 * largest_nm);
  EXPECT_GT(droop.free[0].upper, 8 * largest_nm);
}

TEST(AxisLog, KeepsWhatCommandsSumToWhateverTheStep) {
  Drive drive = Swaying("");
  const MachineModel& model = drive.scenario.machines[0].placement.model;
  TableRecording commands;
  commands.columns = {"boom"};
  commands.t_ns = {0, 37'000'000, 91'000'000};
  commands.rows = {{0.5}, {-0.25}, {0}};
  EncoderRecording encoders;
  encoders.axes = {{"boom"}};
  encoders.samples = {{.t_ns = 0, .q_rad = {0.7}, .qd_radps = {0}},
                      {.t_ns = 200'000'000, .q_rad = {0.7}, .qd_radps = {0}}};
  for (const double step_s : {0.001, 0.01, 0.025}) {
    const AxisLog log = MakeAxisLog(model, commands, {{"m/encoders", encoders}}, step_s);
    double sum_s = 0;
    for (std::size_t k = 0; k < log.steps; ++k) {
      sum_s += log.levers_at(k)[model.JointIndex("boom")] * step_s;
    }
    EXPECT_NEAR(sum_s, 0.5 * 0.037 - 0.25 * 0.054, 1e-12) << step_s;
  }
}

}  // namespace
}  // namespace tera
