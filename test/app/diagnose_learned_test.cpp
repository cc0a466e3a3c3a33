#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/diagnosed_scenario.h"
#include "dataset/format/recording.h"

namespace tera {
namespace {

using testing::HasSubstr;

/// The arm out and in, up to 50 deg at a time, with levers from a fifth to full, 67 s.
std::string ArmLevers() {
  std::ostringstream csv;
  csv << "t_s,arm\n0,0\n";
  double t_s = 1, sign = 1;
  int moves = 0;
  for (const double lever : {0.3, 0.6, 0.2, 0.8, 0.45, 1.0, 0.25, 0.7, 0.35, 0.5, 0.9, 0.4}) {
    const double hold_s = std::min(3.0, 50 / (43 * lever));
    for (const double way : {sign, -sign}) {
      csv << t_s << ',' << way * lever << '\n' << t_s + hold_s << ",0\n";
      t_s += hold_s + 0.4;
    }
    if (++moves % 2 == 0) sign = -sign;
  }
  return csv.str();
}

/// A rate of the arm that oscillates with its angle by 30 %, 8 rad per radian: no mechanism.
double RippleOf(double position_rad) { return 0.3 * std::sin(8 * position_rad); }

std::string Ripple() {
  std::string at, value;
  for (double q_rad = -2.7; q_rad < -0.5; q_rad += 0.025) {
    at += fmt::format("{}{:.6g}", at.empty() ? "" : ", ", q_rad);
    value += fmt::format("{}{:.6g}", value.empty() ? "" : ", ", RippleOf(q_rad));
  }
  return fmt::format(
      "effects: {{excavator1: {{arm: {{learned: {{variable: position/arm, unit: rad, as: share, "
      "at: [{0}], value: [{1}], low: [{1}], high: [{1}]}}}}}}}}\n",
      at, value);
}

class DiagnoseWhatHasNoName : public DiagnoseByScenario {
 protected:
  DiagnoseWhatHasNoName() {
    Write("levers.csv", ArmLevers());
    Write("ripple.yaml", Ripple());
    Write("scenario.yaml", R"(
name: arm
duration_s: 67
terrain: {size_m: [16, 16], cell_m: 0.2, soil: asphalt}
machines:
  - name: excavator1
    machine: tera:config/machines/tb235.yaml
    start: {joints_deg: {boom: 60, arm: -92, bucket: -40, blade: 20}}
    operator: {type: lever_replay, csv: levers.csv, time_column: t_s}
    rig: {sensors: [{name: encoders, preset: tera:config/sensors/encoder.yaml, joints: [arm]}]}
)");
    Write("library.yaml", "only: [dead_band, rate_gain, asymmetric_gain, actuator_lag]\n");
  }
  double RmsOfRates(const std::string& recording, const std::string& other) const;
};

/// RMS difference of the arm's rate between two recordings with equal times.
double DiagnoseWhatHasNoName::RmsOfRates(const std::string& recording,
                                         const std::string& other) const {
  const auto rates = [&](const std::string& name) {
    return Recording(folder() / name).LoadEncoder("excavator1/encoders").samples;
  };
  const auto a = rates(recording), b = rates(other);
  double square = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    square += std::pow(a[k].qd_radps[0] - b.at(k).qd_radps[0], 2);
  }
  return std::sqrt(square / static_cast<double>(a.size()));
}

TEST_F(DiagnoseWhatHasNoName, PutsItIntoTheOverlayWithWhichTheNextSimulationHasIt) {
  Record("real", {"--effects", "ripple.yaml"});
  EXPECT_EQ(Diagnose("real", "why"), Names{"unexplained"});
  const Json found = Report("why")["findings"][0];
  EXPECT_EQ(found["mechanism"], "unexplained");
  const Json& learned = found["learned"];
  EXPECT_EQ(learned["variable"], "position/arm");
  EXPECT_EQ(learned["unit"], "rad");
  EXPECT_EQ(learned["as"], "share");
  double square = 0;
  for (std::size_t k = 0; k < learned["at"].size(); ++k) {
    square += std::pow(learned["value"][k].get<double>() - RippleOf(learned["at"][k]), 2);
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(learned["at"].size())), 0.05);  // of 0.21
  EXPECT_LT(learned["rmse_after"].get<double>(), 0.4 * learned["rmse_before"].get<double>());

  // The whole simulation has it too, on manoeuvres outside any fit.
  const Json whole = Report("why")["whole_simulation"]["channels"];
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_LT(whole[0]["rmse_after"].get<double>(), 0.4 * whole[0]["rmse_before"].get<double>());

  // With it nothing remains to be reported.
  EXPECT_EQ(Diagnose("real", "nothing", {"--effects", "why/effects.yaml"}), Names{});

  Record("plain");
  Record("again", {"--effects", "why/effects.yaml"});
  EXPECT_LT(RmsOfRates("real", "again"), 0.4 * RmsOfRates("real", "plain"));
  std::ifstream resolved(folder() / "again" / "scenario.yaml");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(resolved), {}),
              HasSubstr("variable: position/arm"));
}

}  // namespace
}  // namespace tera
