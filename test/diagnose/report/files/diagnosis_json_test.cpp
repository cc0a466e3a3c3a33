#include "diagnose/report/files/diagnosis_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "diagnose/report/made_diagnosis.h"

namespace tera {
namespace {

using ::testing::HasSubstr;

TEST(DiagnosisJson, HasItsStructureInFixedOrderAndDigits) {
  EXPECT_EQ(DiagnosisJson(Of(BoomWithDeadBand())), R"({
  "format": 2,
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
        "p": 0.001,
        "curve": {
          "at": [
            -0.5,
            0.0,
            0.5
          ],
          "mean": [
            -0.1,
            0.0,
            0.1
          ],
          "low": [
            -0.12,
            -0.02,
            0.08
          ],
          "high": [
            -0.08,
            0.02,
            0.12
          ]
        }
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
      "excess_variance_removed": 0.9,
      "plain_map_rmse": null
    }
  ],
  "channels": [
    {
      "channel": "excavator1/encoders/boom_radps",
      "unit": "rad/s",
      "rms": 3.0,
      "rmse": 1.0,
      "motion": 0.0,
      "noise": null,
      "before": 1.0,
      "after": 0.0,
      "explained_by": [
        "dead_band"
      ],
      "left": "noise"
    }
  ],
  "unconfirmed": [],
  "within_tolerance": [],
  "proxies": [],
  "not_told_apart": [],
  "untestable": [
    {
      "mechanism": "backlash",
      "target": "boom"
    }
  ],
  "not_judged": [],
  "not_compared": [],
  "missing_input": [],
  "excluded_samples": [],
  "out_of_time": [],
  "levers_of": "recording",
  "encoder_lead_s": null,
  "held_out_recordings": [],
  "discrepancy_corrections": [],
  "whole_simulation": null,
  "next_manoeuvre": null
}
)");
}

TEST(DiagnosisJson, HoldsFurtherRecordingsTheWholeSimulationAndTheNextManoeuvre) {
  const std::string text = DiagnosisJson(Complete());
  EXPECT_THAT(text, HasSubstr("\"recording\": \"out/second\""));
  EXPECT_THAT(text, HasSubstr("\"rmse_before\": 0.0523599"));
  EXPECT_THAT(text, HasSubstr("\"follows\": false"));
  EXPECT_THAT(text, HasSubstr("\"from_s\": 40"));
  EXPECT_THAT(text, HasSubstr("\"until_s\": 130"));
  EXPECT_THAT(text, HasSubstr("\"recorded_m\": 57.39"));
  EXPECT_THAT(text, HasSubstr("\"commands_csv\": \"next_manoeuvre.csv\""));
  EXPECT_THAT(text, HasSubstr("\"power\": 0.9"));
}

TEST(DiagnosisJson, HoldsTheReplaysDiscrepancyWhereThereIsASimulation) {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.discrepancy_corrections = {{"excavator1/encoders/boom_radps", "rad/s", true, 0.125, 40},
                                       {"excavator1/base/yaw_radps", "rad/s"}};
  const auto list = nlohmann::json::parse(DiagnosisJson(diagnosis))["discrepancy_corrections"];
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["rms"], 0.125);
  EXPECT_EQ(list[0]["log_likelihood_gain"], 40);
  EXPECT_TRUE(list[0]["applied"].get<bool>());
  EXPECT_TRUE(list[1]["rms"].is_null());
  EXPECT_FALSE(list[1]["applied"].get<bool>());
}

TEST(DiagnosisJson, PutsTheWeightiestFirstAndWhatIsUnexplainedLast) {
  DiagnosedBlock light = BoomWithDeadBand(), heavy = BoomWithDeadBand();
  light.diagnosis.search.flexible_gain = 10;
  light.diagnosis.unexplained = {GrowingBeyond12kNm()};
  heavy.block.channels[0].name = "excavator1/encoders/arm_radps";
  heavy.block.candidates[0].target = "arm";
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

TEST(DiagnosisJson, TellsWhatASensorShowsAsItTellsOtherFindingsAndWhere) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.perception.push_back(LidarWithRangeBias());
  AddRegion(&diagnosis.perception[0]);
  const auto json = nlohmann::json::parse(DiagnosisJson(diagnosis));
  const auto& bias = json["findings"][0];
  EXPECT_EQ(bias["channel"], "excavator1/lidar_roof");
  EXPECT_EQ(bias["mechanism"], "range_bias");
  EXPECT_EQ(bias["slot"], "sensor_static");
  EXPECT_EQ(bias["target"], "lidar_roof");
  EXPECT_EQ(bias["class"], nlohmann::json({"range_bias"}));
  EXPECT_EQ(bias["parameters"]["range_m"]["sigma"], 0.001);
  EXPECT_EQ(bias["held_out"]["excess_variance_removed"], 0.99);
  EXPECT_TRUE(bias["place"].is_null());
  const auto& lower = json["findings"][1];
  EXPECT_EQ(lower["slot"], "ground");
  EXPECT_EQ(lower["parameters"]["volume_m3"]["value"], -1.6);
  EXPECT_EQ(lower["place"]["low_m"], nlohmann::json({6, -3}));
  EXPECT_EQ(lower["intervals_s"], nlohmann::json({{2, 9}}));
}

}  // namespace
}  // namespace tera
