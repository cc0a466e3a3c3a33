#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/units.h"
#include "diagnose/diagnosis.h"
#include "diagnose/perception/registration/registration_block.h"
#include "diagnose/perception/scene/scan_diagnosis.h"
#include "diagnose/statistics/series/simulated.h"
#include "physics/actuation/actuation_mechanisms.h"
#include "physics/traction/ground_mechanisms.h"

/// Hand-made diagnoses for the tests of reports.

namespace tera {

inline const Mechanism& MechanismOf(std::string_view id) {
  for (const auto library : {ActuationMechanisms(), GroundMechanisms()}) {
    for (const Mechanism& mechanism : library) {
      if (mechanism.id == id) return mechanism;
    }
  }
  throw std::runtime_error("no such mechanism");
}

/// 100 s at 2 Hz: measured 3 throughout; simulated 1 too little without findings, exact with them.
inline DiagnosedBlock Block(const std::string& name, const std::string& channel,
                            const std::string& unit) {
  DiagnosedBlock made;
  made.block.name = name;
  const Series measured = MakeSeries(0.5, std::vector<double>(200, 3.0));
  made.block.channels = {{channel, unit, measured, {}, {}, {}}};
  made.block.replay = WholeReplay([](const Structure&) {
    return std::vector<std::vector<double>>{std::vector<double>(200, 2.0)};
  });
  SearchResult& search = made.diagnosis.search;
  search.nothing.misfit.residual = {MakeSeries(0.5, std::vector<double>(200, 1.0))};
  search.found.misfit.residual = {MakeSeries(0.5, std::vector<double>(200, 0.0))};
  search.flexible_gain = 1000;
  made.diagnosis.confirmed = {{0, 0.05, 0.01, 0.9, 1e-5}};
  made.diagnosis.residual_verdicts = {{.channel = 0,
                                       .rmse = 0.6 * kDeg,
                                       .noise = {.at_rest = 0.5 * kDeg, .differences = 0.2 * kDeg},
                                       .flexible_regressor_predicts = true}};
  return made;
}

inline Regime RegimeOf(const std::string& variable, CurveShape shape) {
  Regime regime{variable, false, 0.001, 0.5, shape, {}};
  regime.curve.at = Eigen::Vector3d(-0.5, 0, 0.5);
  regime.curve.mean = Eigen::Vector3d(-0.1, 0, 0.1);
  regime.curve.low = regime.curve.mean.array() - 0.02;
  regime.curve.high = regime.curve.mean.array() + 0.02;
  regime.curve.count = Eigen::Vector3d(50, 100, 50);
  return regime;
}

/// The boom's dead band of 0.18, between 41 and 63 s and between 70 and 75 s.
inline DiagnosedBlock BoomWithDeadBand() {
  DiagnosedBlock made = Block("boom", "excavator1/encoders/boom_radps", "rad/s");
  made.block.candidates = {{&MechanismOf("dead_band"), "boom", {{0, 0, 0.5}}, {{0.1, 0}}},
                           {&MechanismOf("valve_curve"), "boom", {{0, 0.4, 3}}, {{1.5}}},
                           {&MechanismOf("backlash"), "boom", {{0, 0, 0.1}}, {{0.01}}}};
  const Candidate& dead_band = made.block.candidates[0];
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
  finding.evidence.rejected = {{&made.block.candidates[1], 0.003, 40}};
  made.diagnosis.search.found.terms = {finding.term};
  made.diagnosis.search.singles = {{&dead_band, {0.18, 0}, 950, 700},
                                   {&made.block.candidates[1], {1.4}, 400, 300},
                                   {&made.block.candidates[2], {0.001}, 2, -1}};
  made.diagnosis.detectability = {
      {&dead_band, 0.03}, {&made.block.candidates[1], 1.2}, {&made.block.candidates[2], {}}};
  made.diagnosis.findings = {finding};
  return made;
}

inline Unexplained GrowingBeyond12kNm() {
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

inline Diagnosis Of(DiagnosedBlock block) {
  Diagnosis diagnosis{"excavator1", "excavator1", {}};
  diagnosis.blocks.push_back(std::move(block));
  return diagnosis;
}

/// All optional content except the findings.
inline Diagnosis Complete() {
  Diagnosis diagnosis = Of(BoomWithDeadBand());
  diagnosis.held_out = {{"out/second",
                         {{"excavator1/encoders/boom_radps", "rad/s", 3 * kDeg, 0.5 * kDeg, 1e-4}},
                         {"arm"}}};
  diagnosis.whole =
      WholeSimulation{40,
                      130,
                      {{"excavator1/encoders/boom_radps", "rad/s", 2 * kDeg, 0.25 * kDeg},
                       {"excavator1/encoders/slew_radps", "rad/s", 1 * kDeg, 1.5 * kDeg}},
                      PathLengths{57.39, 50.47, 57.2},
                      {},
                      {}};
  NextManoeuvre next;
  next.description = "boom: steps of 0.15";
  next.commands = {{"boom"}, {0, 1000000000}, {{0}, {0.15}}};
  next.duration_s = 34;
  next.discriminated = {{"boom", {"dead_band", "valve_curve"}, true, 0.9}};
  next.not_discriminated = {{"boom", {"backlash", "nothing"}, false, 0.1}};
  next.power = 0.9;
  diagnosis.next = next;
  return diagnosis;
}

/// A lidar on the roof whose ranges are 5 cm too long.
inline PerceptionDiagnosis LidarWithRangeBias() {
  PerceptionDiagnosis made;
  made.channel = "excavator1/lidar_roof";
  made.target = "lidar_roof";
  made.scans = 60;
  made.noise_rmse = 0.004;
  made.sensor_candidates =
      CandidatesOf(EffectTarget::kLidar, ComparedBy::kRanges, "lidar_roof", {});
  Finding finding;
  finding.term = {&made.sensor_candidates[1], {0.05}};
  finding.parameters = {{"range_m", "m", 0.05, 0.001}};
  finding.evidence.p = 1e-6;
  finding.evidence.rivals = {finding.term.candidate};
  finding.held_out = {0, 0.024, 0.004, 0.99, 1e-6};
  made.findings.push_back({finding, {}, {}});
  return made;
}

/// A region of the ground that lies half a metre lower, from the 2nd second to the 9th.
inline void AddRegion(PerceptionDiagnosis* sensor) {
  const std::vector<double> values = {4, -1.6, -0.4, -0.5, -0.1};
  const Mechanism& height = SceneMechanism("terrain_height");
  sensor->scene_candidates.push_back({&height, "ground", {}, {values}, {}});
  Finding finding;
  finding.term = {&sensor->scene_candidates.back(), values};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const EffectParameter& parameter = height.parameters[i];
    finding.parameters.push_back(
        {std::string(parameter.name), std::string(parameter.unit), values[i], {}});
  }
  finding.evidence.p = 1e-6;
  finding.evidence.rivals = {finding.term.candidate};
  finding.held_out = {0, 0.42, 0.16, 0, 1e-6};
  PerceptionFinding found{finding, {}, {{2, 9}}};
  found.place = {{7, -2}, {6, -3}, {8, -1}};
  sensor->findings.push_back(std::move(found));
}

}  // namespace tera
