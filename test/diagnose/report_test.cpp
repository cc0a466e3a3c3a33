#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "core/error.h"
#include "dataset/checked_file.h"
#include "diagnose/report/diagnosis_json.h"
#include "diagnose/report/effects_yaml.h"
#include "diagnose/report/html_report.h"
#include "diagnose/report/next_manoeuvre_text.h"
#include "diagnose/report/sentence.h"
#include "diagnose/report/svg_plot.h"
#include "diagnose/report/wording.h"
#include "diagnose/report/write_report.h"
#include "own_folder.h"
#include "physics/actuation_mechanisms.h"
#include "physics/ground_mechanisms.h"
#include "sim/scenario.h"

namespace tera {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDeg = std::numbers::pi / 180;

const Mechanism& MechanismOf(std::string_view id) {
  for (const auto library : {ActuationMechanisms(), GroundMechanisms()}) {
    for (const Mechanism& mechanism : library) {
      if (mechanism.id == id) return mechanism;
    }
  }
  throw std::runtime_error("no such mechanism");
}

/// 100 s of 2 Hz: 3 measured throughout; simulated 1 short with nothing, right with what was found.
DiagnosedBlock Block(const std::string& name, const std::string& channel, const std::string& unit) {
  DiagnosedBlock made;
  made.block.name = name;
  const Series measured = MakeSeries(0.5, std::vector<double>(200, 3.0));
  made.block.channels = {{channel, unit, measured, {}, {}, {}}};
  made.block.predict = [](const Structure&) {
    return std::vector<std::vector<double>>{std::vector<double>(200, 2.0)};
  };
  SearchResult& search = made.diagnosis.search;
  search.nothing.misfit.residual = {MakeSeries(0.5, std::vector<double>(200, 1.0))};
  search.found.misfit.residual = {MakeSeries(0.5, std::vector<double>(200, 0.0))};
  search.free_gain = 1000;
  made.diagnosis.confirmed = {{0, 0.05, 0.01, 0.9, 1e-5}};
  made.diagnosis.remainders = {{.channel = 0,
                                .rmse = 0.6 * kDeg,
                                .noise = {.at_rest = 0.5 * kDeg, .differences = 0.2 * kDeg},
                                .free_member_tells = true}};
  return made;
}

Regime RegimeOf(const std::string& variable, CurveShape shape) {
  Regime regime{variable, false, 0.001, 0.5, shape, {}};
  regime.curve.at = Eigen::Vector3d(-0.5, 0, 0.5);
  regime.curve.mean = Eigen::Vector3d(-0.1, 0, 0.1);
  regime.curve.low = regime.curve.mean.array() - 0.02;
  regime.curve.high = regime.curve.mean.array() + 0.02;
  regime.curve.count = Eigen::Vector3d(50, 100, 50);
  return regime;
}

/// The boom's dead band of 0.18, between 41 and 63 s and between 70 and 75 s.
DiagnosedBlock BoomWithDeadBand() {
  DiagnosedBlock made = Block("boom", "excavator1/encoders/boom_radps", "rad/s");
  made.block.suspects = {{&MechanismOf("dead_band"), "boom", {{0, 0, 0.5}}, {{0.1, 0}}},
                         {&MechanismOf("valve_curve"), "boom", {{0, 0.4, 3}}, {{1.5}}},
                         {&MechanismOf("backlash"), "boom", {{0, 0, 0.1}}, {{0.01}}}};
  const Suspect& dead_band = made.block.suspects[0];
  Finding finding;
  finding.term = {&dead_band, {0.1812, 0}};
  finding.parameters = {{"width", "1", 0.1812, 0.0213}, {"asymmetry", "1", 0, {}}};
  finding.evidence.share = 0.9;
  finding.evidence.rivals = {&dead_band};
  finding.location = {0, {{82, 126}, {140, 150}}, {}};
  finding.location.regimes = {
      RegimeOf("lever/boom",
               {.form = CurveForm::kLocal, .parity = CurveParity::kOdd, .low = -0.2, .high = 0.2})};
  finding.held_out = {0, 3.1 * kDeg, 0.6 * kDeg, 0.94, 0.004};
  finding.evidence.p = 0.0002;
  finding.evidence.rejected = {{&made.block.suspects[1], 0.003, 40}};
  made.diagnosis.search.found.terms = {finding.term};
  made.diagnosis.search.singles = {{&dead_band, {0.18, 0}, 950, 700},
                                   {&made.block.suspects[1], {1.4}, 400, 300},
                                   {&made.block.suspects[2], {0.001}, 2, -1}};
  made.diagnosis.detectability = {
      {&dead_band, 0.03}, {&made.block.suspects[1], 1.2}, {&made.block.suspects[2], {}}};
  made.diagnosis.findings = {finding};
  return made;
}

Unexplained GrowingBeyond12kNm() {
  Unexplained left;
  left.location = {0, {{24, 40}}, {}};
  left.location.regimes = {RegimeOf("load/arm", {.form = CurveForm::kThreshold,
                                                 .parity = CurveParity::kEven,
                                                 .low = -12000,
                                                 .high = 12000,
                                                 .outside = true})};
  left.p = 0.00041;
  left.share = 0.35;
  left.rmse = 0.9 * kDeg;
  left.noise = 0.2 * kDeg;
  return left;
}

Diagnosis Of(DiagnosedBlock block) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.blocks.push_back(std::move(block));
  return diagnosis;
}

TEST(Sentence, TellsWhereOnWhatWhichHowSureAndHowMuchBetter) {
  const DiagnosedBlock boom = BoomWithDeadBand();
  EXPECT_EQ(
      SentenceOf(boom, boom.diagnosis.findings[0]),
      "Boom rate, 41–63 s and 1 more interval; the error depends on |lever| < 0.2, odd: dead "
      "band 0.18 ± 0.02 (chosen with p 0.0002, confirmed with p 0.004; rivals rejected: valve "
      "curve (p 0.003)). Held-out RMSE 3.1 → 0.6 deg/s, 94 % of the excess variance removed. "
      "Left: 0.6 deg/s at a noise of 0.5 deg/s.");
}

TEST(Sentence, OfAClassNamesAllThatAreAlike) {
  DiagnosedBlock boom = BoomWithDeadBand();
  Finding& finding = boom.diagnosis.findings[0];
  finding.evidence.rivals.push_back(&boom.block.suspects[1]);
  finding.evidence.rejected.clear();
  finding.parameters[0].sigma.reset();
  finding.location.regimes[0].p = 0.3;
  finding.location.intervals.clear();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  EXPECT_EQ(
      SentenceOf(boom, finding),
      "Boom rate, the whole recording; the error depends most on |lever| < 0.2, odd (p 0.3): "
      "dead band 0.181 (chosen with p 0.0002, confirmed with p 0.004; not told apart from: valve "
      "curve). Held-out RMSE 3.1 → 0.6 deg/s, 94 % of the excess variance removed.");
}

TEST(Sentence, NamesNumbersWhereAMechanismHasSeveralAndWritesAnglesInDegrees) {
  DiagnosedBlock arm = Block("arm", "excavator1/encoders/arm_radps", "rad/s");
  arm.block.suspects = {
      {&MechanismOf("end_cushion"), "arm", {{0, 0.02, 0.6}, {1, 0.02, 0.9}}, {{0.1, 0.2}}}};
  Finding finding;
  finding.term = {&arm.block.suspects[0], {10 * kDeg, 0.25}};
  finding.parameters = {{"zone_rad", "rad", 10 * kDeg, 0.5 * kDeg},
                        {"end_ratio", "1", 0.25, 0.012}};
  finding.evidence.rivals = {finding.term.suspect};
  finding.location = {0, {{2, 3}}, {}};
  finding.location.regimes = {RegimeOf("position/arm", {.form = CurveForm::kThreshold,
                                                        .parity = CurveParity::kNotTested,
                                                        .low = 60 * kDeg,
                                                        .high = 75 * kDeg})};
  finding.held_out = {0, 2 * kDeg, 2 * kDeg, -0.01, 0.5};
  finding.evidence.p = 1e-7;
  arm.diagnosis.remainders[0].kind = Remainder::Kind::kUnknown;
  arm.diagnosis.remainders[0].free_member_tells = false;
  arm.block.first_ns = FromSeconds(45);
  EXPECT_EQ(
      SentenceOf(arm, finding),
      "Arm rate, 46.00–46.50 s; the error depends on angle from 60 to 75 deg, growing: end "
      "cushion 10.0 ± 0.5 deg, end ratio 0.250 ± 0.012 (chosen with p < 0.0001, confirmed with p "
      "0.5). Held-out RMSE 2 → 2 deg/s, none of the excess variance removed. Left: 0.6 deg/s at a "
      "noise of 0.5 deg/s, of noise or error, which a recording without rest does not tell, and no "
      "free curve that could tell whether there is more.");
}

TEST(Sentence, OfTheUnexplainedSaysOnWhatItDepends) {
  DiagnosedBlock boom = BoomWithDeadBand();
  EXPECT_EQ(
      SentenceOf(boom, GrowingBeyond12kNm()),
      "Boom rate, 12.0–20.0 s; the error depends on |arm load| > 12000 N m, growing, even: no "
      "known mechanism explains it (p 0.00041; 35 % of what a free curve could explain). Left: 0.9 "
      "deg/s at a noise of 0.2 deg/s.");
  Unexplained loud = GrowingBeyond12kNm();
  loud.p.reset();
  EXPECT_THAT(SentenceOf(boom, loud),
              HasSubstr("no known mechanism explains it (nor does a free curve). Left: 0.9 deg/s"));
}

TEST(Sentence, OfAnErrorThatIsAShareOfTheSimulatedValueSaysSo) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings[0].location.regimes[0].is_share = true;
  EXPECT_THAT(
      SentenceOf(boom, boom.diagnosis.findings[0]),
      HasSubstr("the error is a share of the simulated value that depends on |lever| < 0.2"));
}

TEST(Sentence, OfWhatWasNotConfirmedOrNotJudgedFollowsTheFindings) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unconfirmed = std::move(boom.diagnosis.findings);
  boom.diagnosis.findings.clear();
  boom.diagnosis.unconfirmed[0].held_out.p = 0.3;
  Diagnosis diagnosis = Of(std::move(boom));
  DiagnosedBlock arm = Block("arm", "excavator1/encoders/arm_radps", "rad/s");
  arm.diagnosis.is_testable = false;
  diagnosis.blocks.push_back(std::move(arm));
  EXPECT_THAT(
      SentencesOf(diagnosis),
      ElementsAre(HasSubstr("Nothing found: boom rate agrees"),
                  "Boom rate: dead band 0.18 ± 0.02 was chosen (p 0.0002) and is not confirmed on "
                  "manoeuvres kept back (p 0.3).",
                  "Arm rate: not judged, for it is moved in too few manoeuvres of the recording."));
  EXPECT_THAT(VerdictsOf(diagnosis), ElementsAre(Verdict::kNone, Verdict::kUntestable));
  diagnosis.blocks.erase(diagnosis.blocks.begin());
  EXPECT_THAT(VerdictsOf(diagnosis), ElementsAre(Verdict::kUntestable));
}

TEST(Sentence, OfNothingNamesTheChannelsAndWhatWasNotSeen) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.findings.clear();
  boom.diagnosis.remainders[0].kind = Remainder::Kind::kOfFew;
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.blocks.push_back(Block("excavator1/base", "excavator1/base/left_mps", "m/s"));
  EXPECT_THAT(
      SentencesOf(diagnosis),
      ElementsAre("Nothing found: boom rate and sideways speed agree with the simulation, but for "
                  "noise and what nominal numbers are off by. Not so in a few manoeuvres of boom "
                  "rate. Of 3 mechanisms looked for, 1 could "
                  "not have been seen "
                  "at any size."));
  EXPECT_THAT(SentencesOf({"excavator1", "excavator1", {}}),
              ElementsAre(HasSubstr("Nothing compared")));
}

TEST(Wording, GivesAsManyDigitsAsANumberIsKnownTo) {
  EXPECT_EQ(WithSigma(0.1812, 0.0213), "0.18 ± 0.02");
  EXPECT_EQ(WithSigma(52345, 870), "52300 ± 900");
  EXPECT_EQ(WithSigma(1.2345, 0.0149), "1.234 ± 0.015");
  EXPECT_EQ(WithSigma(-0.00123, 0.00098), "-0.0012 ± 0.0010");
  EXPECT_EQ(WithSigma(20.04, {}), "20");
  EXPECT_EQ(Significant(0.0996, 2), "0.1");
  EXPECT_EQ(Significant(3.14159, 2), "3.1");
  EXPECT_EQ(Significant(0, 2), "0");
  EXPECT_EQ(Significant(1.234e-7, 2), "1.2e-07");
  EXPECT_EQ(ProbabilityText(1e-9), "p < 0.0001");
}

TEST(DiagnosisJson, HasItsStructureInFixedOrderAndDigits) {
  EXPECT_EQ(DiagnosisJson(Of(BoomWithDeadBand())), R"({
  "verdict": [
    "named",
    "untestable"
  ],
  "findings": [
    {
      "channel": "excavator1/encoders/boom_radps",
      "intervals_s": [
        [
          41.0,
          63.0
        ],
        [
          70.0,
          75.0
        ]
      ],
      "regime": {
        "variable": "lever/boom",
        "error": "value",
        "low": -0.2,
        "high": 0.2,
        "shape": "odd local",
        "p": 0.001
      },
      "mechanism": "dead_band",
      "slot": "lever_map",
      "target": "boom",
      "parameters": {
        "width": {
          "value": 0.1812,
          "sigma": 0.0213,
          "unit": "1"
        },
        "asymmetry": {
          "value": 0.0,
          "sigma": null,
          "unit": "1"
        }
      },
      "class": [
        "dead_band"
      ],
      "rejected": [
        {
          "mechanism": "valve_curve",
          "p": 0.003
        }
      ],
      "evidence": {
        "p_chosen": 0.0002,
        "p_confirmed": 0.004
      },
      "confidence": 0.995801,
      "held_out": {
        "rmse_before": 0.0541052,
        "rmse_after": 0.010472,
        "unit": "rad/s",
        "excess_variance_removed": 0.94
      }
    }
  ],
  "held_out": [
    {
      "channel": "excavator1/encoders/boom_radps",
      "rmse_before": 0.05,
      "rmse_after": 0.01,
      "unit": "rad/s",
      "excess_variance_removed": 0.9
    }
  ],
  "channels": [
    {
      "channel": "excavator1/encoders/boom_radps",
      "unit": "rad/s",
      "rms": 3.0,
      "rmse": 1.0
    }
  ],
  "unconfirmed": [],
  "untestable": [
    {
      "mechanism": "backlash",
      "target": "boom",
      "smallest_detectable": null
    }
  ],
  "not_judged": [],
  "not_compared": [],
  "out_of_time": [],
  "held_out_recordings": [],
  "whole_simulation": null,
  "next_manoeuvre": null
}
)");
}

/// All that may stand beside the findings.
Diagnosis Complete() {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.held_out = {{"out/second",
                         {{"excavator1/encoders/boom_radps", "rad/s", 3 * kDeg, 0.5 * kDeg, 1e-4}},
                         {"arm"}}};
  diagnosis.whole =
      WholeSimulation{90,
                      {{"excavator1/encoders/boom_radps", "rad/s", 2 * kDeg, 0.25 * kDeg},
                       {"excavator1/encoders/slew_radps", "rad/s", 1 * kDeg, 1.5 * kDeg}},
                      PathLengths{57.39, 50.47, 57.2},
                      {},
                      {}};
  NextManoeuvre next;
  next.description = "boom: steps of 0.15";
  next.commands = {{"boom"}, {0, 1000000000}, {{0}, {0.15}}};
  next.duration_s = 34;
  next.separates = {{"boom", {"dead_band", "valve_curve"}, true, 0.9}};
  next.leaves = {{"boom", {"backlash", "nothing"}, false, 0.1}};
  next.power = 0.9;
  diagnosis.next = next;
  return diagnosis;
}

TEST(Sentence, OfFurtherRecordingsAndTheWholeSimulationComparesAndWarns) {
  const std::vector<std::string> sentences = SentencesOf(Complete());
  EXPECT_THAT(sentences,
              ::testing::Contains("On out/second, which nothing was fitted to: RMSE of boom rate 3 "
                                  "→ 0.5 deg/s. It says nothing of arm."));
  EXPECT_THAT(sentences, ::testing::Contains(
                             "The whole simulation as it was and with what was found, first 90 s, "
                             "manoeuvres kept back: boom rate 2 → 0.25 deg/s and slew rate 1 → 1.5 "
                             "deg/s; path 57.39 m recorded, 50.47 → 57.2 m simulated. The whole "
                             "simulation does not follow: slew rate."));
}

TEST(Sentence, OfTheNextManoeuvreCountsMechanismsWhereTheyAreMany) {
  NextManoeuvre next;
  for (const char* mechanism : {"sag", "backlash", "dead_band", "rate_limit"}) {
    next.separates.push_back({"slew", {mechanism, "nothing"}, false, 0.9});
    EXPECT_THAT(
        SentenceOf(next),
        HasSubstr(next.separates.size() < 4 ? "sag" : "would show 4 mechanisms of the slew"));
  }
}

TEST(DiagnosisJson, HoldsFurtherRecordingsTheWholeSimulationAndTheNextManoeuvre) {
  const std::string text = DiagnosisJson(Complete());
  EXPECT_THAT(text, HasSubstr("\"recording\": \"out/second\""));
  EXPECT_THAT(text, HasSubstr("\"rmse_before\": 0.0523599"));
  EXPECT_THAT(text, HasSubstr("\"follows\": false"));
  EXPECT_THAT(text, HasSubstr("\"recorded_m\": 57.39"));
  EXPECT_THAT(text, HasSubstr("\"commands_csv\": \"next_manoeuvre.csv\""));
  EXPECT_THAT(text, HasSubstr("\"power\": 0.9"));
}

TEST(DiagnosisJson, PutsTheWeightiestFirstAndWhatIsUnexplainedLast) {
  DiagnosedBlock light = BoomWithDeadBand(), heavy = BoomWithDeadBand();
  light.diagnosis.search.free_gain = 10;
  light.diagnosis.unexplained = {GrowingBeyond12kNm()};
  heavy.block.channels[0].name = "excavator1/encoders/arm_radps";
  heavy.block.suspects[0].target = "arm";
  Diagnosis diagnosis = Of(std::move(light));
  diagnosis.blocks.push_back(std::move(heavy));
  const std::string text = DiagnosisJson(diagnosis);
  const auto arm = text.find("\"target\": \"arm\""), boom = text.find("\"target\": \"boom\"");
  const auto unexplained = text.find("\"mechanism\": \"unexplained\"");
  EXPECT_LT(arm, boom);
  EXPECT_LT(boom, unexplained);
  ASSERT_NE(unexplained, text.npos);
  const std::string last = text.substr(unexplained);
  EXPECT_THAT(last, HasSubstr("\"slot\": null"));
  EXPECT_THAT(last, HasSubstr("\"parameters\": {}"));
  EXPECT_THAT(last, HasSubstr("\"rmse_before\": 0.015708,"));
  EXPECT_THAT(text, HasSubstr("\"shape\": \"even threshold outside\""));
}

/// The scenario of one machine with an overlay over it.
Scenario Overlaid(const std::string& overlay) {
  const std::filesystem::path file = OwnFolder() / "effects.yaml";
  WriteWholeFile(file, overlay);
  const Config config =
      Config::FromFile(DataRoot() / "config/scenarios/quickstart.yaml", {}, {{file, "effects"}});
  Scenario scenario = ReadScenario(config.root());
  config.Finish();
  return scenario;
}

const Effects& BoomEffects(const Scenario& scenario) {
  const MachineModel& model = scenario.machines[0].placement.model;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].name == "boom") return model.effects.joints[j];
  }
  throw std::runtime_error("no boom");
}

TEST(EffectsYaml, IsWhatGenerateReadsBack) {
  const std::string text = EffectsYaml(Of(BoomWithDeadBand()), "site\n7/run");
  EXPECT_EQ(text,
            "# What the recording site?7/run shows of excavator1 beyond its simulation.\n"
            "effects:\n"
            "  excavator1:\n"
            "    boom:\n"
            "      dead_band: {width: 0.1812}\n");
  const Scenario scenario = Overlaid(text);
  const Effect* effect = FindEffect(BoomEffects(scenario), "dead_band");
  ASSERT_NE(effect, nullptr);
  EXPECT_EQ((*effect)["width"], 0.1812);
  EXPECT_EQ((*effect)["asymmetry"], 0);
}

TEST(EffectsYaml, OfNothingIsAnOverlayThatChangesNothing) {
  const std::string text = EffectsYaml({"excavator1", "excavator1", {}}, "run");
  EXPECT_THAT(text, HasSubstr("effects: {}\n"));
  EXPECT_EQ(FindEffect(BoomEffects(Overlaid(text)), "dead_band"), nullptr);
}

TEST(EffectsYaml, LeavesOutWhatIsOfThePosesWhichNoSimulationHas) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.blocks[0].block.suspects[0].target = "poses";
  EXPECT_THAT(EffectsYaml(diagnosis, "run"), HasSubstr("\neffects: {}\n"));
  EXPECT_THAT(SentencesOf(diagnosis)[0], HasSubstr("dead band of the poses"));
}

TEST(EffectsYaml, QuotesNamesThatYamlWouldReadAsSomethingElse) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.scenario = "digger: no 7's";
  EXPECT_THAT(EffectsYaml(diagnosis, "run"), HasSubstr("\n  'digger: no 7''s':\n"));
}

/// Whether every tag is closed in its order.
bool IsBalanced(const std::string& html) {
  std::vector<std::string> open;
  for (auto at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    const std::string tag = html.substr(at + 1, html.find('>', at) - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.starts_with("!") || tag.ends_with("/") || name == "meta") continue;
    if (!tag.starts_with("/")) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(HtmlReport, HoldsTheSentencesAndNeedsNothingElse) {
  DiagnosedBlock boom = BoomWithDeadBand();
  boom.diagnosis.unexplained = {GrowingBeyond12kNm()};
  Diagnosis diagnosis = Of(std::move(boom));
  diagnosis.blocks.push_back(Block("arm", "excavator1/encoders/arm_radps", "rad/s"));
  const std::string html = HtmlReport(diagnosis, "a<b>&'c'");
  EXPECT_TRUE(IsBalanced(html));
  for (const std::string& sentence : SentencesOf(diagnosis)) {
    EXPECT_THAT(html, HasSubstr(Escaped(sentence)));
  }
  EXPECT_TRUE(IsBalanced(HtmlReport(Complete(), "run")));
  EXPECT_THAT(HtmlReport(Complete(), "run"), ::testing::AllOf(HasSubstr("What to record next"),
                                                              HasSubstr("Further confirmation")));
  EXPECT_THAT(html, HasSubstr("a&lt;b&gt;&amp;&#39;c&#39;"));
  EXPECT_THAT(html, HasSubstr("Where they agree"));
  EXPECT_THAT(html, HasSubstr("<code>backlash</code>"));
  for (const char* outside : {"http", "src=", "url(", "<script", "<link", "@import"}) {
    EXPECT_THAT(html, Not(HasSubstr(outside)));
  }
  for (const char* broken : {"nan", "inf'", "inf "}) EXPECT_THAT(html, Not(HasSubstr(broken)));
}

/// Drawn coordinates of the first path of a class.
std::string PathOf(const std::string& html, const std::string& css_class) {
  const std::string head = "<path class='" + css_class + "' d='";
  const auto at = html.find(head);
  if (at == html.npos) return "";
  return html.substr(at + head.size(), html.find('\'', at + head.size()) - at - head.size());
}

TEST(HtmlReport, DrawsPredictionsAsMeasurementsLessResiduals) {
  const std::string html = HtmlReport(Of(BoomWithDeadBand()), "run");
  const std::string measured = PathOf(html, "line measured");
  ASSERT_NE(measured, "");
  EXPECT_EQ(measured, PathOf(html, "line after"));  // nothing is left
  // 3 measured and 2 simulated, the axis a twentieth of 1 wider than from 2 to 3 of the 204 px
  // between 10 and 214: measured lies 204 / 22 below the upper edge, simulated as far above the
  // lower.
  EXPECT_THAT(measured, HasSubstr(" 19.3"));
  EXPECT_THAT(PathOf(html, "line before"), HasSubstr(" 204.7"));
}

TEST(Envelope, KeepsTheLowestAndHighestOfEachBinInTheirOrder) {
  Series series = MakeSeries(0.5, {0, 5, -1, 2, /**/ 7, 7, 8, 1, /**/ 0, 0, 0, 0});
  for (std::size_t k = 8; k < 12; ++k) series.valid[k] = 0;
  const auto line = EnvelopeOf(series, {0, 12}, 2, 6);
  ASSERT_EQ(line.size(), 5u);
  EXPECT_EQ(line[0].x, 0.5);
  EXPECT_EQ(line[0].y, 10);
  EXPECT_EQ(line[1].x, 1);
  EXPECT_EQ(line[1].y, -2);
  EXPECT_EQ(line[2].x, 3);
  EXPECT_EQ(line[2].y, 16);
  EXPECT_EQ(line[3].x, 3.5);
  EXPECT_EQ(line[3].y, 2);
  EXPECT_TRUE(std::isnan(line[4].y));
}

TEST(Envelope, OfALongRecordingHasNoMorePointsThanAsked) {
  std::vector<double> value(60011);
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = std::sin(0.37 * static_cast<double>(k));
  EXPECT_LE(EnvelopeOf(MakeSeries(0.01, value), {0, value.size()}, 1, 1500).size(), 1500u);
}

TEST(Ticks, AreRoundAndWithinTheAxis) {
  EXPECT_LT(TicksOf(Widened(1, std::nextafter(1, 2), ""), 5).size(), 20u);
  EXPECT_THAT(TicksOf({0, 10, ""}, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(TicksOf({-0.3, 0.7, ""}, 4), ElementsAre(0, 0.5));
  EXPECT_THAT(TicksOf({41, 63, ""}, 5), ElementsAre(45, 50, 55, 60));
}

TEST(WriteReport, LeavesThreeWholeFiles) {
  const std::filesystem::path folder = OwnFolder() / "report";
  const Diagnosis diagnosis = Of(BoomWithDeadBand());
  WriteReport(folder, diagnosis, "run");
  EXPECT_EQ(ReadWholeFile(folder / "diagnosis.json"), DiagnosisJson(diagnosis));
  EXPECT_EQ(ReadWholeFile(folder / "effects.yaml"), EffectsYaml(diagnosis, "run"));
  EXPECT_EQ(ReadWholeFile(folder / "report.html"), HtmlReport(diagnosis, "run"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 3);
}

TEST(WriteReport, AddsTheLeversToDriveNext) {
  const std::filesystem::path folder = OwnFolder() / "with_levers";
  WriteReport(folder, Complete(), "run");
  EXPECT_EQ(ReadWholeFile(folder / "next_manoeuvre.csv"), "t_ns,boom\n0,0\n1000000000,0.15\n");
}

TEST(WriteReport, SaysWhereItCannotWrite) {
  WriteWholeFile(OwnFolder() / "a_file", "");
  EXPECT_THROW(WriteReport(OwnFolder() / "a_file", Of(BoomWithDeadBand()), "run"), InputError);
}

}  // namespace
}  // namespace tera
