#include "diagnose/report/text/cause_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "diagnose/blocks/measured_poses.h"
#include "diagnose/report/made_diagnosis.h"
#include "diagnose/report/text/words.h"
#include "sensors/sensor_mechanisms.h"

namespace tera {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<const Mechanism*> AllMechanisms() {
  std::vector<const Mechanism*> all;
  for (const auto library :
       {ActuationMechanisms(), GroundMechanisms(), SensorMechanisms(), PoseMechanisms()}) {
    for (const Mechanism& mechanism : library) all.push_back(&mechanism);
  }
  return all;
}

/// The mechanism with this id and parameter.
const Mechanism& Having(std::string_view id, std::string_view parameter) {
  for (const Mechanism* mechanism : AllMechanisms()) {
    if (mechanism->id != id) continue;
    if (parameter.empty()) return *mechanism;
    for (const EffectParameter& one : mechanism->parameters) {
      if (one.name == parameter) return *mechanism;
    }
  }
  throw std::runtime_error("no such mechanism");
}

/// Candidates of findings, which must outlive them.
struct Made {
  Candidate candidate;
  Finding finding;
};

/// A finding of a mechanism with some numbers, the only free ones; others have their defaults.
void Make(const Mechanism& mechanism, const std::string& target,
          const std::map<std::string, double>& numbers, Made* made) {
  made->candidate = {&mechanism, target, {}, {}, {}, {}};
  Finding& finding = made->finding;
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i) {
    const EffectParameter& parameter = mechanism.parameters[i];
    const auto at = numbers.find(std::string(parameter.name));
    const double value = at == numbers.end() ? parameter.otherwise.value_or(0) : at->second;
    if (at != numbers.end()) {
      made->candidate.free.push_back({i, parameter.lower, parameter.upper});
    }
    finding.term.values.push_back(value);
    finding.parameters.push_back(
        {std::string(parameter.name), std::string(parameter.unit), value, {}});
  }
  finding.term.candidate = &made->candidate;
  finding.evidence.rivals = {&made->candidate};
}

std::string Meaning(const Mechanism& mechanism, const std::string& target,
                    const std::map<std::string, double>& numbers) {
  Made made;
  Make(mechanism, target, numbers, &made);
  return MeaningText({.finding = &made.finding});
}

/// Expected sentence of a finding, from the equations and signatures of
/// docs/reference/mechanisms.md.
struct Expected {
  std::string_view id;
  std::string target;
  std::map<std::string, double> numbers;
  std::string text;
};

const std::vector<Expected>& WrittenByHand() {
  static const std::vector<Expected> expected = {
      {"dead_band",
       "boom",
       {{"width", 0.1204}},
       "The boom does not move while its lever is within 12 % of neutral."},
      {"command_delay",
       "arm",
       {{"delay_s", 0.122}},
       "The arm answers its lever only after 0.12 s."},
      {"lever_saturation",
       "slew",
       {{"limit", 0.7}},
       "Beyond 70 % of full lever the slew gets no faster."},
      // y = |u|^n: below u for n > 1, and above it for n < 1.
      {"valve_curve",
       "boom",
       {{"exponent", 1.5}},
       "At small levers the boom moves slower than in proportion to the lever: its speed goes with "
       "the lever to the power of 1.5."},
      {"valve_curve",
       "boom",
       {{"exponent", 0.8}},
       "At small levers the boom moves faster than in proportion to the lever: its speed goes with "
       "the lever to the power of 0.8."},
      {"asymmetric_gain",
       "bucket",
       {{"ratio", 1.4}},
       "Under negative levers the bucket moves 40 % faster than under positive ones of the same "
       "size."},
      {"rate_gain",
       "left_track",
       {{"gain", 0.85}},
       "At every lever the left track moves 15 % slower than the scenario says."},
      {"flow_sharing",
       "main",
       {{"capacity", 0.8}},
       "The pump main delivers 80 % of its nominal flow at most, so that what it feeds slows down "
       "while several functions move at once."},
      // 20 rad/s are 3.2 turns a second; e^(-6 t) is 1 / e after 1 / 6 s.
      {"actuator_ring",
       "arm",
       {{"eta_radps", 20}, {"beta_1ps", 6}},
       "After each change of its lever the arm swings at 3.2 Hz; the swing falls to a third in "
       "0.17 s."},
      // 0.0119 rad are 0.68 deg.
      {"backlash",
       "slew",
       {{"gap_rad", 0.01187}},
       "The slew has play: 0.68 deg of motion are lost at each reversal."},
      {"coulomb_friction",
       "boom",
       {{"effort_nm", 1200}},
       "Dry friction costs the drive of the boom 1200 N m more at every speed."},
      {"payload",
       "bucket",
       {{"mass_kg", 300}},
       "The bucket carries 300 kg that the scenario does not have."},
      // The left track runs at V (1 - a / 2), the right one at V (1 + a / 2).
      {"track_asymmetry",
       "base",
       {{"difference", -0.042}},
       "At the same turning of the sprockets the right track runs 4.2 % slower than the left one, "
       "so that the machine drives a curve where it should drive straight on."},
      {"track_scale",
       "base",
       {{"scale", 0.9}},
       "For the same turning of the sprockets the tracks carry the machine 10 % less far."},
      // w_z = (u_r - u_l) / (r B): a larger r turns less.
      {"effective_gauge",
       "base",
       {{"ratio", 1.68}},
       "The machine turns as if its tracks were 1.7 times as far apart: less than they ask for."},
      {"side_slip",
       "base",
       {{"drift_per_slope", 0.2}},
       "On a side slope the machine drifts sideways as it drives, by 0.2 times the gradient across "
       "the travel."},
      {"imu_lever_arm",
       "imu",
       {{"x_m", 0.2}, {"z_m", -0.1}},
       "The inertial unit imu sits elsewhere on its link than documented, by x 0.2 m, z -0.1 m."},
      {"clock_offset",
       "gnss_left",
       {{"offset_s", 18}},
       "The clock of the sensor gnss left is 18 s ahead."},
      {"clock_offset", "imu", {{"offset_s", -0.3}}, "The clock of the sensor imu is 0.3 s behind."},
      {"height_datum",
       "gnss_left",
       {{"offset_m", -0.36}},
       "All heights of the receiver gnss left are 0.36 m too low."},
      {"latency",
       "poses",
       {{"delay_s", 0.25}},
       "The recorded poses are stamped 0.25 s after they were measured."},
      {"arrival_stamps",
       "poses",
       {},
       "The recorded poses bear the times at which they arrived, not those at which they were "
       "measured."},
      {"range_bias",
       "lidar_roof",
       {{"range_m", -0.05}},
       "The sensor lidar roof measures every distance 0.05 m too short."},
  };
  return expected;
}

std::string Heading(const Cause& cause) {
  return HeadingOf(*cause.finding->term.candidate, cause.finding->evidence.rivals);
}

TEST(PlainSentence, SaysWhatAMechanismMeansForTheMachine) {
  for (const Expected& expected : WrittenByHand()) {
    const std::string first = expected.numbers.empty() ? "" : expected.numbers.begin()->first;
    EXPECT_EQ(Meaning(Having(expected.id, first), expected.target, expected.numbers),
              expected.text);
  }
}

TEST(PlainSentence, TellsOfAnEncoderByItsJoint) {
  EXPECT_EQ(Meaning(Having("bias", "angle_deg"), "encoders/boom", {{"angle_deg", 1.5}}),
            "The encoder of the boom is off by a constant, at rest too: angle 1.5 deg.");
  EXPECT_EQ(Meaning(Having("axis_flip", "x"), "imu", {{"x", 0}, {"z", 1}}),
            "The inertial unit imu counts backwards along z.");
}

TEST(PlainSentence, TellsOfSeveralNumbersWithTheirDeviations) {
  Made made;
  Make(Having("mount_rotation", "yaw_deg"), "imu",
       {{"roll_deg", 1.5}, {"pitch_deg", -2.3}, {"yaw_deg", 0.02}}, &made);
  for (ParameterEstimate& estimate : made.finding.parameters) estimate.sigma = 0.05;
  EXPECT_THAT(MeaningText({.finding = &made.finding}),
              HasSubstr(": roll 1.50 ± 0.05 deg, pitch -2.30 ± 0.05 deg, yaw 0.02 ± 0.05 deg."));
}

// A new mechanism of the library needs its own words.
TEST(PlainSentence, EveryMechanismHasOneOfItsOwn) {
  std::map<std::string, std::string_view> id_of_meaning;
  for (const Mechanism* mechanism : AllMechanisms()) {
    const MechanismWords* words = WordsOf(mechanism->id);
    ASSERT_NE(words, nullptr) << mechanism->id << " has no words in words.cpp";
    EXPECT_FALSE(words->label.empty() || words->meaning.empty()) << mechanism->id;
    const auto [at, is_new] = id_of_meaning.emplace(words->meaning, mechanism->id);
    EXPECT_TRUE(is_new || at->second == mechanism->id)
        << mechanism->id << " and " << at->second << " share a sentence";
  }
}

TEST(PlainSentence, EveryPlaceOfEverySentenceIsFilled) {
  for (const Mechanism* mechanism : AllMechanisms()) {
    std::map<std::string, double> numbers;
    for (const EffectParameter& one : mechanism->parameters) {
      numbers[std::string(one.name)] = one.lower + 0.75 * (one.upper - one.lower);
    }
    const std::string target = mechanism->ActsOn(EffectTarget::kBase) ? "base" : "some_name";
    const std::string text = Meaning(*mechanism, target, numbers);
    EXPECT_THAT(text,
                Not(AnyOf(HasSubstr("{"), HasSubstr("}"), HasSubstr("  "), HasSubstr("nan"))));
    EXPECT_TRUE(text.ends_with(".")) << text;
    EXPECT_EQ(text, Capitalised(text));
  }
}

TEST(PlainSentence, LabelsAreAFewWords) {
  for (const Mechanism* mechanism : AllMechanisms()) {
    const std::string_view label = WordsOf(mechanism->id)->label;
    EXPECT_LE(std::count(label.begin(), label.end(), ' '), 3) << label;
    EXPECT_LE(label.size(), 24u) << label;
  }
}

/// The dead band of Complete(), with a valve curve as rival.
Diagnosis NotToldApart() {
  Diagnosis diagnosis = Complete();
  Finding& finding = diagnosis.blocks[0].diagnosis.findings[0];
  finding.evidence.rivals.push_back(&diagnosis.blocks[0].block.candidates[1]);
  return diagnosis;
}

TEST(CauseAnswers, ACauseWithoutRivalsIsAsSureAsItsProbabilities) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  const auto how_sure = [&](double confirmed_p) {
    diagnosis.blocks[0].diagnosis.findings[0].held_out.p = confirmed_p;
    return HowSureText(CausesOf(diagnosis)[0]);
  };
  EXPECT_EQ(how_sure(0.004), "Sure.");
  EXPECT_EQ(how_sure(0.04), "Fairly sure.");
  EXPECT_EQ(how_sure(1e-5), "Very sure.");
}

TEST(CauseAnswers, AClassIsSureOfSomethingAndNotOfWhich) {
  const Diagnosis diagnosis = NotToldApart();
  const Cause cause = CausesOf(diagnosis)[0];
  EXPECT_EQ(HowSureText(cause), "Sure that something is wrong here, not which of 2 causes it is.");
  EXPECT_EQ(Heading(cause), "Boom: dead band or valve curve");
}

// The error grows by 2.4 / 0.4, 3.1 / 0.6 and 0.42 / 0.16 without them.
TEST(CauseAnswers, OfJointsSensorsAndTheSceneComeByWhatTheyRemove) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.perception.push_back(LidarWithRangeBias());
  AddRegion(&diagnosis.perception[0]);
  const std::vector<Cause> causes = CausesOf(diagnosis);
  ASSERT_EQ(causes.size(), 3u);
  EXPECT_EQ(MeaningText(causes[0]),
            "The sensor lidar roof measures every distance 0.05 m too long.");
  EXPECT_EQ(Heading(causes[1]), "Boom: dead band");
  EXPECT_EQ(MeaningText(causes[2]), "");  // a place, which no sentence of a mechanism has
}

TEST(CauseAnswers, ErrorThatIsLeftIsAWarning) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  const Diagnosis diagnosis = Of(std::move(boom));
  EXPECT_THAT(HowSureText(CausesOf(diagnosis)[0]), HasSubstr("do not trust the number yet"));
}

}  // namespace
}  // namespace tera
